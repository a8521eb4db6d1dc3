// report.html: one file that shows the results of a study, offline, with its images. The page itself is report/: its
// style and modules are joined when Quell is built and stand in every report.
#pragma once

#include "core/lab/report_pixels.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace quell {

struct ReportImage {
  enum class Kind { image, reference, input, map };
  Kind kind = Kind::image;
  std::string variant;   // of images and maps; else empty
  std::string sequence;  // as results.json names it
  int frame = 0;
  std::string metric;               // of maps, else empty
  std::function<HalfImage()> read;  // called once, so that not all images need be in memory; images are linear
};

struct ReportGraph {
  std::string variant;
  std::string svg;                   // as draw_svg makes it
  std::vector<std::string> changed;  // nodes to mark: those that the base does not have, or has otherwise
  std::vector<std::string> removed;  // nodes that only the base has
};

struct Report {
  std::string results;  // text of results.json
  std::string
      timings;  // text of timings.json; its variants' "name" and "cost_ms" are read; empty when nothing was timed
  std::vector<ReportImage> images;
  std::vector<ReportGraph> graphs;
};

struct ReportSize {
  std::size_t bytes = 0;         // of the file
  std::size_t image_bytes = 0;   // of the images in it
  std::size_t image_halves = 0;  // what these take unpacked, in bytes
};

// Takes about 0.37 MB of file for a denoised frame of 480x270, 0.77 MB for an unfiltered one. Throws Error when the
// file cannot be written, std::invalid_argument for parts that are not as described above, and what `read` throws; no
// file is left then.
ReportSize write_report_html(const std::string& path, const Report&);

}  // namespace quell
