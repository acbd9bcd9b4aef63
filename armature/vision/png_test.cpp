// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/png.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

namespace armature::vision {
namespace {

std::size_t number_at(std::string_view text, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t i = at; i < at + 4; ++i)
    number = number << 8 | static_cast<unsigned char>(text[i]);
  return number;
}

struct Chunk {
  std::string_view type;
  std::string_view content;
};

/// Each with a valid check sum.
std::vector<Chunk> chunks_of(std::string_view file) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at + 12 <= file.size();) {
    const std::size_t size = number_at(file, at);
    const std::string_view body = file.substr(at + 4, size + 4);
    const uLong check =
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    EXPECT_EQ(number_at(file, at + 8 + size), check);
    chunks.push_back({body.substr(0, 4), body.substr(4)});
    at += 12 + size;
  }
  return chunks;
}

TEST(Png, HasThePixelsOfItsImage) {
  Image image({3, 2});
  image.set(0, 0, {1, 2, 3});
  image.set(2, 1, {255, 0, 128});
  const std::string file = png_of(image.view());
  EXPECT_EQ(file.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const std::vector<Chunk> chunks = chunks_of(file);
  ASSERT_EQ(chunks.size(), 3u);
  EXPECT_EQ(chunks[0].type, "IHDR");
  EXPECT_EQ(chunks[0].content, std::string_view("\0\0\0\3\0\0\0\2\x08\x02\0\0\0", 13));
  ASSERT_EQ(chunks[1].type, "IDAT");
  EXPECT_EQ(chunks[2].type, "IEND");
  EXPECT_TRUE(chunks[2].content.empty());

  std::string rows(20, 'x');
  uLongf size = rows.size();
  const auto* const content = reinterpret_cast<const Bytef*>(chunks[1].content.data());
  ASSERT_EQ(
      uncompress(reinterpret_cast<Bytef*>(rows.data()), &size, content, chunks[1].content.size()),
      Z_OK);
  std::string expected;
  for (std::size_t at = 0; at < image.bytes().size(); ++at) {
    if (at % 9 == 0) expected += '\0';
    expected += static_cast<char>(image.bytes()[at]);
  }
  EXPECT_EQ(rows, expected);
  EXPECT_EQ(size, 20u);
}

}  // namespace
}  // namespace armature::vision
