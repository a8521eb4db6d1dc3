// OpenCV as an opponent: its images, from ours and beside ours.
#pragma once

#include "core/image/image.h"

#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace quell::bench {

// Channels side by side, as OpenCV holds them.
inline cv::Mat interleaved(const quell_image& image) {
  cv::Mat out(image.height, image.width, CV_32FC(image.channels));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels; ++c)
        out.ptr<float>(y)[x * image.channels + c] = image.plane[c][y * image.pitch + x];
  return out;
}

// Largest difference farther than `border` from the sides, where the two know different pixels.
inline double largest_difference(const quell_image& a, const cv::Mat& b, int border) {
  double most = 0;
  for (int y = border; y < a.height - border; ++y)
    for (int x = border; x < a.width - border; ++x)
      for (int c = 0; c < a.channels; ++c)
        most = std::max(most, std::abs(double(a.plane[c][y * a.pitch + x]) - b.ptr<float>(y)[x * a.channels + c]));
  return most;
}

}  // namespace quell::bench
