// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/assembler.hpp"

#include <algorithm>
#include <cstring>

namespace armature::ride::internal {

std::span<std::byte> Assembler::room() {
  if (!bytes_) bytes_.reset(new std::byte[kRoom]);  // Untouched, so that it takes no memory yet.
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
    parts = parts_.insert(parts_.end(), Parts{message.header, taken_, {}, false});
  }
  add(*parts, message.body);
  if (message.header.continues) return Found::kNothing;
  kept_ -= parts->body.size();
  whole_.splice(whole_.begin(), parts_, parts);
  message.body = whole_.front().body.bytes();
  return whole_.front().too_large ? Found::kTooLarge : Found::kMessage;
}

/// Of a body that is too large its beginning is kept, to say whose it was.
void Assembler::add(Parts& parts, std::span<const std::byte> body) {
  if (!parts.too_large && body.size() > most_body_ - std::min(kept_, most_body_)) {
    parts.too_large = true;
    kept_ -= parts.body.size();
    Body beginning;
    beginning.append(parts.body.bytes().first(std::min(parts.body.size(), kBeginning)));
    parts.body = std::move(beginning);
    kept_ += parts.body.size();
  }
  if (parts.too_large) {
    body = body.first(std::min(body.size(), kBeginning - std::min(parts.body.size(), kBeginning)));
  }
  parts.body.append(body);
  kept_ += body.size();
}

}  // namespace armature::ride::internal
