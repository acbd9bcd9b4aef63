// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/replacement.hpp"

#include <algorithm>
#include <utility>

namespace armature::edit {
namespace {

/// Part of a text that is edited: bytes [begin, end) of the original, or new text.
struct Piece {
  bool kept = true;
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;

  std::size_t size() const { return kept ? end - begin : text.size(); }

  /// The first `size` bytes; this piece has the rest.
  Piece take_front(std::size_t size) {
    Piece front = *this;
    if (kept) {
      front.end = begin + size;
      begin += size;
    } else {
      front.text.resize(size);
      text.erase(0, size);
    }
    return front;
  }
};

std::vector<Piece> pieces_of(std::size_t size, const std::vector<Replacement>& replacements) {
  std::vector<Piece> pieces;
  std::size_t copied = 0;
  for (const Replacement& one : replacements) {
    pieces.push_back({true, copied, one.begin, {}});
    pieces.push_back({false, 0, 0, one.text});
    copied = one.end;
  }
  pieces.push_back({true, copied, size, {}});
  return pieces;
}

/// Takes pieces from the front of a text.
class PieceReader {
 public:
  explicit PieceReader(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  std::vector<Piece> take_until(std::size_t position) {
    std::vector<Piece> taken;
    while (at_ < pieces_.size() && position_ < position) {
      Piece& next = pieces_[at_];
      const std::size_t wanted = std::min(position - position_, next.size());
      position_ += wanted;
      if (wanted == next.size()) {
        taken.push_back(std::move(next));
        ++at_;
      } else {
        taken.push_back(next.take_front(wanted));
      }
    }
    return taken;
  }

  std::vector<Piece> take_rest() {
    return {std::make_move_iterator(pieces_.begin() + static_cast<std::ptrdiff_t>(at_)),
            std::make_move_iterator(pieces_.end())};
  }

 private:
  std::vector<Piece> pieces_;
  std::size_t at_ = 0;
  std::size_t position_ = 0;
};

std::vector<Replacement> replacements_of(std::size_t size, const std::vector<Piece>& pieces) {
  std::vector<Replacement> replacements;
  Replacement next;
  const auto finish = [&](std::size_t end) {
    next.end = end;
    if (next.begin != next.end || !next.text.empty()) replacements.push_back(next);
    next.text.clear();
  };
  for (const Piece& piece : pieces) {
    if (!piece.kept) {
      next.text += piece.text;
    } else if (piece.size() > 0) {
      finish(piece.begin);
      next.begin = piece.end;
    }
  }
  finish(size);
  return replacements;
}

}  // namespace

std::string replaced(std::string_view text, const std::vector<Replacement>& replacements) {
  std::string result;
  std::size_t copied = 0;
  for (const Replacement& one : replacements) {
    result += text.substr(copied, one.begin - copied);
    result += one.text;
    copied = one.end;
  }
  result += text.substr(copied);
  return result;
}

std::vector<Replacement> inverse_of(std::string_view text,
                                    const std::vector<Replacement>& replacements) {
  std::vector<Replacement> inverse;
  std::size_t added = 0;
  std::size_t removed = 0;
  for (const Replacement& one : replacements) {
    const std::size_t begin = one.begin + added - removed;
    inverse.push_back(
        {begin, begin + one.text.size(), std::string(text.substr(one.begin, one.end - one.begin))});
    added += one.text.size();
    removed += one.end - one.begin;
  }
  return inverse;
}

std::vector<Replacement> composed(std::size_t size, const std::vector<Replacement>& first,
                                  const std::vector<Replacement>& second) {
  PieceReader reader(pieces_of(size, first));
  std::vector<Piece> pieces;
  const auto add = [&](std::vector<Piece> more) {
    std::move(more.begin(), more.end(), std::back_inserter(pieces));
  };
  for (const Replacement& one : second) {
    add(reader.take_until(one.begin));
    reader.take_until(one.end);
    pieces.push_back({false, 0, 0, one.text});
  }
  add(reader.take_rest());
  return replacements_of(size, pieces);
}

}  // namespace armature::edit
