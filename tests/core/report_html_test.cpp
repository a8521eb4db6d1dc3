// The report's packing, and what write_report_html takes and refuses. What the page does is tested in a browser.
#include "core/lab/report.h"

#include "core/report/error.h"
#include "tests/support/scratch.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace quell::test {

namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

HalfImage random_image(int width, int height, int planes) {
  std::mt19937 random(std::uint32_t(width * 1000 + height));
  HalfImage image{width, height, planes, {}};
  for (int i = 0; i < width * height * planes; ++i) image.halves.push_back(std::uint16_t(random()));
  return image;
}

// The definition, read the other way round: the median of left, up and left + up − corner, by sorting.
HalfImage unpacked(const std::vector<std::uint8_t>& bytes, int width, int height, int planes) {
  HalfImage image{width, height, planes, {}};
  const auto at = [&](int p, int x, int y) {
    return x < 0 || y < 0 ? 0 : int(image.halves[std::size_t((p * height + y) * width + x)]);
  };
  for (int p = 0; p < planes; ++p)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const int left = at(p, x - 1, y), up = at(p, x, y - 1), corner = x && y ? at(p, x - 1, y - 1) : 0;
        int three[] = {left, up, left + up - corner};
        std::sort(three, three + 3);
        const std::size_t i = image.halves.size();
        const int code = bytes[i] + 256 * bytes[bytes.size() / 2 + i];
        image.halves.push_back(std::uint16_t(three[1] + (code % 2 ? -(code + 1) / 2 : code / 2)));
      }
  const auto size = std::size_t(width) * std::size_t(height);
  for (std::size_t i = 0; planes == 3 && i < size; ++i) {
    image.halves[i] = std::uint16_t(image.halves[i] + image.halves[size + i]);
    image.halves[2 * size + i] = std::uint16_t(image.halves[2 * size + i] + image.halves[size + i]);
  }
  return image;
}

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Report small_report() {
  Report report;
  report.results = R"({"quell_results": 1, "name": "</script><script>alert(1)</script>", "variants": []})";
  report.images.push_back({ReportImage::Kind::input, "", "room", 3, "", [] { return random_image(5, 4, 3); }});
  report.graphs.push_back({"base", "<svg><script>alert(2)</script></svg>", {"blend"}, {}});
  return report;
}

TEST(ReportPixels, ResidualsAreThoseOfTheMedianPredictor) {
  for (const int planes : {1, 3})
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {17, 3}, {64, 31}}) {
      const auto image = random_image(width, height, planes);
      EXPECT_EQ(unpacked(residuals(image), width, height, planes).halves, image.halves) << width << "x" << height;
    }
}

// Of a flat image only the first pixel is left; of a slope its step.
TEST(ReportPixels, ResidualsOfSmoothImagesAreSmall) {
  HalfImage flat{4, 3, 1, std::vector<std::uint16_t>(12, 0x3c00)};
  std::vector<std::uint8_t> wanted(24, 0);
  wanted[12] = 0x78;  // 2 · 0x3c00, its high byte
  EXPECT_EQ(residuals(flat), wanted);
  HalfImage slope{4, 1, 1, {10, 13, 16, 15}};
  EXPECT_EQ(residuals(slope), (std::vector<std::uint8_t>{20, 6, 6, 1, 0, 0, 0, 0}));
}

TEST(ReportPixels, DeflatesToZlibsFormat) {
  const auto bytes = residuals(random_image(33, 7, 3));
  const auto packed = deflated(bytes);
  std::vector<std::uint8_t> back(bytes.size());
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  EXPECT_EQ(libdeflate_zlib_decompress(inflater.get(), packed.data(), packed.size(), back.data(), back.size(), nullptr),
            LIBDEFLATE_SUCCESS);
  EXPECT_EQ(back, bytes);
}

// RFC 4648, section 10.
TEST(ReportPixels, Base64HasItsGoldens) {
  const std::pair<const char*, const char*> goldens[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : goldens) EXPECT_EQ(base64(bytes_of(plain)), coded);
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xfb, 0xff, 0xfe}), "+//+");
}

TEST(ReportPixels, RefusesSizesThatDoNotFit) {
  for (const auto& [width, height, planes, halves] :
       {std::tuple{2, 2, 1, 3}, {0, 4, 1, 0}, {-1, -4, 1, 4}, {2, 2, 2, 8}, {2, 2, 4, 16}, {2, 2, 3, 4}})
    EXPECT_THROW(packed_image({width, height, planes, std::vector<std::uint16_t>(std::size_t(halves))}),
                 std::invalid_argument)
        << width << "x" << height << "x" << planes;
}

TEST(ReportHtml, SaysHowLargeItIs) {
  const Scratch scratch;
  const auto size = write_report_html(scratch.path("report.html"), small_report());
  EXPECT_EQ(size.bytes, fs::file_size(scratch.path("report.html")));
  EXPECT_EQ(size.image_bytes, packed_image(random_image(5, 4, 3)).size());
  EXPECT_EQ(size.image_halves, 5u * 4 * 3 * 2);
}

TEST(ReportHtml, LetsNoTextOutOfItsElement) {
  const Scratch scratch;
  write_report_html(scratch.path("report.html"), small_report());
  const auto page = text_of(scratch.path("report.html"));
  EXPECT_EQ(page.find("alert(1)</script>"), page.npos);
  EXPECT_EQ(page.find("<script>alert"), page.npos);
  EXPECT_NE(page.find("alert(1)"), page.npos);
  for (const char* mark : {"@POLICY@", "@STYLE@", "@DATA@", "@SCRIPT@"}) EXPECT_EQ(page.find(mark), page.npos) << mark;
}

TEST(ReportHtml, IsTheSameEachTime) {
  const Scratch scratch;
  write_report_html(scratch.path("a.html"), small_report());
  write_report_html(scratch.path("b.html"), small_report());
  EXPECT_EQ(text_of(scratch.path("a.html")), text_of(scratch.path("b.html")));
}

TEST(ReportHtml, LeavesNothingBehindWhenItFails) {
  const Scratch scratch;
  auto bad = small_report();
  bad.results = "{";
  EXPECT_THROW(write_report_html(scratch.path("report.html"), bad), std::invalid_argument);
  bad = small_report();
  bad.timings = "no";
  EXPECT_THROW(write_report_html(scratch.path("report.html"), bad), std::invalid_argument);
  bad = small_report();
  bad.images[0].read = []() -> HalfImage { throw Error(Exit::input, "no such image"); };
  EXPECT_THROW(write_report_html(scratch.path("report.html"), bad), Error);
  EXPECT_TRUE(fs::is_empty(scratch.folder()));
}

}  // namespace

}  // namespace quell::test
