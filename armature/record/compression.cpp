// SPDX-License-Identifier: Apache-2.0
#include "armature/record/internal/compression.hpp"

#ifdef ARMATURE_ZSTD
#include <zstd.h>
#endif
#ifdef ARMATURE_LZ4
#include <lz4frame.h>
#endif

namespace armature::record::internal {
namespace {

/// More is no chunk of a recording, and would take the memory of whoever reads it.
constexpr std::size_t kMostDecompressed = std::size_t{1} << 28;

[[maybe_unused]] base::Error lacks(std::string_view what) {
  return base::Error{"this armature was built without " + std::string(what) + ": install lib" +
                     std::string(what) + "-dev and build it anew"};
}

base::Error damaged(std::string_view compression) {
  return base::Error{"the chunk is no " + std::string(compression) + ", or damaged"};
}

#ifdef ARMATURE_ZSTD
std::string zstd(std::string_view bytes) {
  std::string to(ZSTD_compressBound(bytes.size()), '\0');
  to.resize(ZSTD_compress(to.data(), to.size(), bytes.data(), bytes.size(), ZSTD_CLEVEL_DEFAULT));
  return to;
}

bool from_zstd(std::string_view bytes, std::string& to) {
  return ZSTD_decompress(to.data(), to.size(), bytes.data(), bytes.size()) == to.size();
}
#endif

#ifdef ARMATURE_LZ4
std::string lz4(std::string_view bytes) {
  std::string to(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  to.resize(LZ4F_compressFrame(to.data(), to.size(), bytes.data(), bytes.size(), nullptr));
  return to;
}

bool from_lz4(std::string_view bytes, std::string& to) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return false;
  std::size_t done = 0;
  std::size_t left = 1;  // 0 once the frame is whole
  while (left != 0 && LZ4F_isError(left) == 0) {
    std::size_t room = to.size() - done;
    std::size_t used = bytes.size();
    left = LZ4F_decompress(context, to.data() + done, &room, bytes.data(), &used, nullptr);
    if (room == 0 && used == 0) break;
    done += room;
    bytes.remove_prefix(used);
  }
  LZ4F_freeDecompressionContext(context);
  return left == 0 && done == to.size() && bytes.empty();
}
#endif

}  // namespace

base::Result<void> can_compress(std::string_view compression) {
  if (compression.empty()) return {};
  if (compression == "zstd") {
#ifdef ARMATURE_ZSTD
    return {};
#else
    return lacks(compression);
#endif
  }
  if (compression == "lz4") {
#ifdef ARMATURE_LZ4
    return {};
#else
    return lacks(compression);
#endif
  }
  return base::Error{"expected zstd, lz4 or nothing, found '" + std::string(compression) + "'"};
}

std::string compressed([[maybe_unused]] std::string_view compression, std::string_view bytes) {
#ifdef ARMATURE_ZSTD
  if (compression == "zstd") return zstd(bytes);
#endif
#ifdef ARMATURE_LZ4
  if (compression == "lz4") return lz4(bytes);
#endif
  return std::string(bytes);
}

base::Result<std::string> decompressed(std::string_view compression, std::string_view bytes,
                                       std::size_t size) {
  if (auto can = can_compress(compression); !can) return base::Error{can.error()};
  if (size > kMostDecompressed) return base::Error{"the chunk has more than 256 MB"};
  std::string to(size, '\0');
  bool whole = false;
#ifdef ARMATURE_ZSTD
  if (compression == "zstd") whole = from_zstd(bytes, to);
#endif
#ifdef ARMATURE_LZ4
  if (compression == "lz4") whole = from_lz4(bytes, to);
#endif
  if (!whole) return damaged(compression);
  return to;
}

}  // namespace armature::record::internal
