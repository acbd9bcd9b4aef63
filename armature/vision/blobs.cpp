// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/blobs.hpp"

#include <algorithm>

namespace armature::vision {
namespace {

Blob blob_of(const BlobFinder::Run& run) {
  const std::int64_t area = run.end - run.begin;
  const std::int64_t columns = area * (run.begin + run.end - 1) / 2;
  return {
      static_cast<int>(area), {run.begin, run.row, run.end, run.row + 1}, columns, area * run.row};
}

void add_to(Blob& blob, const Blob& more) {
  blob.area += more.area;
  blob.columns += more.columns;
  blob.rows += more.rows;
  blob.box.left = std::min(blob.box.left, more.box.left);
  blob.box.top = std::min(blob.box.top, more.box.top);
  blob.box.right = std::max(blob.box.right, more.box.right);
  blob.box.bottom = std::max(blob.box.bottom, more.box.bottom);
}

}  // namespace

BlobFinder::BlobFinder(ImageShape shape) : shape_(shape) {
  const std::size_t runs_of_row = (static_cast<std::size_t>(shape.width) + 1) / 2;
  const std::size_t height = static_cast<std::size_t>(shape.height);
  runs_.reserve(runs_of_row * height);
  // Of two rows no more runs can be apart from each other than of one.
  const std::size_t labels = runs_of_row * ((height + 1) / 2);
  blobs_.reserve(labels);
  parents_.reserve(labels);
}

std::span<const Blob> BlobFinder::find(std::span<const std::uint8_t> mask) noexcept {
  runs_.clear();
  blobs_.clear();
  parents_.clear();
  above_ = row_begin_ = 0;
  for (int row = 0; row < shape_.height; ++row) {
    above_ = row_begin_;
    row_begin_ = runs_.size();
    add_runs_of(
        row, mask.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(shape_.width));
  }
  keep_roots();
  return blobs_;
}

void BlobFinder::add_runs_of(int row, const std::uint8_t* pixels) noexcept {
  const std::uint8_t* const end = pixels + shape_.width;
  const auto is_set = [](std::uint8_t pixel) { return pixel != 0; };
  for (const std::uint8_t* at = pixels;;) {
    const std::uint8_t* const begin = std::find_if(at, end, is_set);
    if (begin == end) return;
    at = std::find(begin, end, std::uint8_t{0});
    add({row, static_cast<int>(begin - pixels), static_cast<int>(at - pixels)});
  }
}

void BlobFinder::add(Run run) noexcept {
  run.blob = label_of(run);
  add_to(blobs_[static_cast<std::size_t>(run.blob)], blob_of(run));
  runs_.push_back(run);
}

/// That of the runs above which it touches, united; or a new one.
int BlobFinder::label_of(const Run& run) noexcept {
  while (above_ < row_begin_ && runs_[above_].end < run.begin) ++above_;
  int label = -1;
  for (std::size_t i = above_; i < row_begin_ && runs_[i].begin <= run.end; ++i) {
    const int touched = root_of(runs_[i].blob);
    label = label < 0 ? touched : unite(label, touched);
  }
  if (label >= 0) return label;
  label = static_cast<int>(parents_.size());
  parents_.push_back(label);
  blobs_.push_back({0, blob_of(run).box, 0, 0});
  return label;
}

int BlobFinder::root_of(int label) noexcept {
  for (;;) {
    int& parent = parents_[static_cast<std::size_t>(label)];
    if (parent == label) return label;
    parent = parents_[static_cast<std::size_t>(parent)];  // halves the way of the next who asks
    label = parent;
  }
}

/// @return the root of both: the one that came first
int BlobFinder::unite(int a, int b) noexcept {
  if (a == b) return a;
  const auto [root, other] = std::minmax({a, b});
  add_to(blobs_[static_cast<std::size_t>(root)], blobs_[static_cast<std::size_t>(other)]);
  parents_[static_cast<std::size_t>(other)] = root;
  return root;
}

/// Roots move to the front, and runs say where they have gone.
void BlobFinder::keep_roots() noexcept {
  for (Run& run : runs_) run.blob = root_of(run.blob);
  std::size_t kept = 0;
  for (std::size_t label = 0; label < parents_.size(); ++label) {
    if (parents_[label] != static_cast<int>(label)) continue;
    blobs_[kept] = blobs_[label];
    parents_[label] = static_cast<int>(kept++);
  }
  for (Run& run : runs_) run.blob = parents_[static_cast<std::size_t>(run.blob)];
  blobs_.resize(kept);
}

}  // namespace armature::vision
