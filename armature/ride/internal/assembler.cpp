// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/assembler.hpp"

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

#include "armature/ride/memory_share.hpp"

namespace armature::ride::internal {

std::span<std::byte> Assembler::room() {
  if (!bytes_) {
    std::unique_ptr<std::byte[]> bytes(new std::byte[kRoom]);  // Untouched: it takes no memory yet.
    if (share_ != nullptr && !share_->take(kRoom)) throw std::bad_alloc();
    bytes_ = std::move(bytes);
  }
  if (begin_ == end_) {
    begin_ = end_ = 0;
  } else if (begin_ != 0 && kRoom - end_ < Header::kMostLength) {
    std::memmove(bytes_.get(), bytes_.get() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  return {bytes_.get() + end_, std::min(kRoom - end_, std::max(kLeastRoom, missing()))};
}

/// Of the message that has begun.
std::size_t Assembler::missing() const {
  const std::size_t there = end_ - begin_;
  if (there < Header::kSize) return 0;
  const auto header = read_header(bytes_.get() + begin_);
  return header && header->length > there ? header->length - there : 0;
}

void Assembler::reset() {
  begin_ = end_ = 0;
  if (bytes_ != nullptr && share_ != nullptr) share_->give(kRoom);
  bytes_.reset();
  parts_.clear();
  whole_.clear();
  kept_ = 0;
}

Found Assembler::next(Message& message) {
  whole_.clear();
  while (end_ - begin_ >= Header::kSize) {
    const std::byte* const at = bytes_.get() + begin_;
    const auto header = read_header(at);
    if (!header) return Found::kBadMagic;
    message.header = *header;
    if (header->length < Header::kSize) return Found::kBadLength;
    if (header->length > end_ - begin_) break;
    begin_ += header->length;
    ++taken_;
    message.body = {at + Header::kSize, header->length - Header::kSize};
    message.whole = nullptr;
    if (!header->continues && parts_.empty()) return Found::kMessage;
    const Found found = join(message);
    if (found != Found::kNothing) return found;
  }
  // What can be no header need not be waited for.
  const std::size_t magic = std::min(end_ - begin_, Header::kMagic.size());
  const bool is_magic =
      std::equal(bytes_.get() + begin_, bytes_.get() + begin_ + magic, Header::kMagic.begin(),
                 [](std::byte a, char b) { return std::to_integer<char>(a) == b; });
  return is_magic ? Found::kNothing : Found::kBadMagic;
}

std::list<Assembler::Parts>::iterator Assembler::find(const Header& header) {
  return std::ranges::find_if(parts_, [&](const Parts& parts) {
    return parts.header.type == header.type && parts.header.identifier == header.identifier;
  });
}

Found Assembler::join(Message& message) {
  auto parts = find(message.header);
  if (parts == parts_.end()) {
    if (!message.header.continues) return Found::kMessage;
    if (parts_.size() == kMostParts) return Found::kTooMany;
    parts = parts_.insert(parts_.end(), Parts{message.header, taken_, Body(share_)});
    if (gate_ != nullptr && !gate_->admits(message)) parts->end = Found::kNothing;
  }
  add(*parts, message.body);
  if (message.header.continues) return Found::kNothing;
  kept_ -= parts->body.size();
  whole_.splice(whole_.begin(), parts_, parts);
  message.body = whole_.front().body.bytes();
  message.whole = &whole_.front().body;
  return whole_.front().end;
}

void Assembler::add(Parts& parts, std::span<const std::byte> body) {
  if (parts.end == Found::kMessage) {
    if (body.size() > most_body_ - std::min(kept_, most_body_)) {
      keep_beginning(parts, Found::kTooLarge);
    } else if (!keep(parts, body)) {
      keep_beginning(parts, Found::kNoMemory);
    } else {
      return;
    }
  }
  const std::size_t missing = kBeginning - std::min(parts.body.size(), kBeginning);
  keep(parts, body.first(std::min(body.size(), missing)));
}

/// False if there is no memory for it.
bool Assembler::keep(Parts& parts, std::span<const std::byte> body) {
  try {
    parts.body.append(body);
  } catch (const std::bad_alloc&) {
    return false;
  }
  kept_ += body.size();
  return true;
}

/// Of a body that is not taken its beginning is kept, to say whose it was.
void Assembler::keep_beginning(Parts& parts, Found end) {
  parts.end = end;
  kept_ -= parts.body.size();
  parts.body.truncate(kBeginning);
  parts.body.shrink(kBeginning);
  kept_ += parts.body.size();
}

}  // namespace armature::ride::internal
