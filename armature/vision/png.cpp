// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/png.hpp"

#include <cstdint>
#include <string_view>

#include <zlib.h>

namespace armature::vision {
namespace {

std::string big_endian(std::size_t number) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>((number >> shift) & 0xff);
  return text;
}

const Bytef* bytes_of(std::string_view text) { return reinterpret_cast<const Bytef*>(text.data()); }

std::string chunk(std::string_view type, std::string_view content) {
  const std::string body = std::string(type) + std::string(content);
  const uLong check = crc32(0, bytes_of(body), static_cast<uInt>(body.size()));
  return big_endian(content.size()) + body + big_endian(check);
}

/// Each row after a byte that says how it is filtered: not.
std::string filtered(const ImageView& image) {
  const std::size_t row = kBytesOfPixel * static_cast<std::size_t>(image.shape.width);
  std::string text;
  text.reserve(image.shape.bytes() + static_cast<std::size_t>(image.shape.height));
  for (std::size_t at = 0; at < image.shape.bytes(); at += row) {
    text += '\0';
    text.append(reinterpret_cast<const char*>(image.data + at), row);
  }
  return text;
}

std::string compressed(std::string_view text) {
  uLongf size = compressBound(text.size());
  std::string small(size, '\0');
  // It cannot fail but for want of room, of which there is enough.
  compress(reinterpret_cast<Bytef*>(small.data()), &size, bytes_of(text), text.size());
  small.resize(size);
  return small;
}

}  // namespace

std::string png_of(const ImageView& image) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  constexpr std::string_view kEightBitsRgb("\x08\x02\0\0\0", 5);
  const std::string header = big_endian(static_cast<std::size_t>(image.shape.width)) +
                             big_endian(static_cast<std::size_t>(image.shape.height)) +
                             std::string(kEightBitsRgb);
  return std::string(kSignature) + chunk("IHDR", header) +
         chunk("IDAT", compressed(filtered(image))) + chunk("IEND", "");
}

}  // namespace armature::vision
