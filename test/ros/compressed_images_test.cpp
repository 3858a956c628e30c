// SPDX-License-Identifier: BSD-3-Clause
#include "ros/images/compressed_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "support/throws_saying.h"

using namespace cabinet_articulation;
using test::ThrowsSaying;
using testing::HasSubstr;

namespace {

sensor_msgs::CompressedImage compressed(const char* suffix, cv::Size size) {
  sensor_msgs::CompressedImage message;
  message.format = suffix;
  cv::imencode(suffix, cv::Mat(size, CV_8UC1, cv::Scalar(90)), message.data);
  return message;
}

/// After the bytes `marker`, at `offset`.
void overwrite(std::vector<std::uint8_t>* data, const std::vector<std::uint8_t>& marker, int offset,
               const std::vector<std::uint8_t>& bytes) {
  const auto at = std::search(data->begin(), data->end(), marker.begin(), marker.end());
  ASSERT_NE(at, data->end());
  std::copy(bytes.begin(), bytes.end(), at + static_cast<std::ptrdiff_t>(marker.size()) + offset);
}

}  // namespace

TEST(CompressedImages, AreWhatWasCompressed) {
  for (const char* suffix : {".png", ".jpg"}) {
    const sensor_msgs::ImagePtr image = decompressed(compressed(suffix, {40, 30}), "left");
    EXPECT_EQ(image->width, 40U) << suffix;
    EXPECT_EQ(image->height, 30U) << suffix;
    EXPECT_EQ(image->encoding, "mono8") << suffix;
    EXPECT_EQ(image->data, std::vector<std::uint8_t>(40 * 30, 90)) << suffix;
  }
}

TEST(CompressedImages, LargeOnesAreRefusedBeforeTheyAreDecoded) {
  sensor_msgs::CompressedImage png = compressed(".png", {40, 30});
  overwrite(&png.data, {'I', 'H', 'D', 'R'}, 0, {0, 0, 0x30, 0, 0, 0, 0x30, 0});
  EXPECT_THAT([&] { decompressed(png, "left"); },
              ThrowsSaying<std::invalid_argument>("left: width * height is 1.50995e+08, expected 1 to 6.71089e+07 px"));
  sensor_msgs::CompressedImage jpeg = compressed(".jpg", {40, 30});
  overwrite(&jpeg.data, {0xff, 0xc0}, 3, {0x70, 0});
  EXPECT_THAT([&] { decompressed(jpeg, "left"); },
              ThrowsSaying<std::invalid_argument>("left: height is 28672, expected 1 to 16384 px"));
}

TEST(CompressedImages, SizesThatAreHiddenAreFoundOrRefused) {
  // A chunk before the first that must be.
  sensor_msgs::CompressedImage png = compressed(".png", {40, 30});
  const std::vector<std::uint8_t> chunk{0, 0, 0, 8, 't', 'E', 'X', 't', 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0};
  png.data.insert(png.data.begin() + 8, chunk.begin(), chunk.end());
  EXPECT_THAT([&] { decompressed(png, "left"); }, ThrowsSaying<std::invalid_argument>(HasSubstr("that cannot be decoded")));
  // Markers without a length before the frame's, and behind them what would be one.
  sensor_msgs::CompressedImage jpeg = compressed(".jpg", {40, 30});
  overwrite(&jpeg.data, {0xff, 0xc0}, 3, {0x70, 0});
  const std::vector<std::uint8_t> alone{0xff, 0xd0, 0xff, 0x01, 0xff, 0x00};
  jpeg.data.insert(jpeg.data.begin() + 2, alone.begin(), alone.end());
  EXPECT_THAT([&] { decompressed(jpeg, "left"); },
              ThrowsSaying<std::invalid_argument>("left: height is 28672, expected 1 to 16384 px"));
}

TEST(CompressedImages, OtherBytesAreRefused) {
  sensor_msgs::CompressedImage other;
  EXPECT_THAT([&] { decompressed(other, "left"); },
              ThrowsSaying<std::invalid_argument>(HasSubstr("left: format is '' with 0 bytes that cannot be decoded")));
  other.format = "jpeg";
  other.data = {0xff, 0xd8, 0xff, 0xff, 0xff, 0xe0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_THAT([&] { decompressed(other, "left"); },
              ThrowsSaying<std::invalid_argument>(HasSubstr("that cannot be decoded, expected a complete JPEG or PNG")));
}
