// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "armature/base/fixed_text.hpp"

namespace armature::component {

/// A reason that people read; held in place, so that real-time code can give one.
using Reason = base::FixedText<511>;

/// The answer of a hook or a command: accepted, or refused with a reason.
class [[nodiscard]] Outcome {
 public:
  static Outcome accepted() { return {}; }
  static Outcome refused(std::string_view reason) {
    Outcome outcome;
    outcome.accepted_ = false;
    outcome.reason_ = reason;
    return outcome;
  }

  bool ok() const { return accepted_; }
  explicit operator bool() const { return accepted_; }
  std::string_view reason() const { return reason_.view(); }

 private:
  bool accepted_ = true;
  Reason reason_;
};

/// What a hook returns: `return accepted();` or `return refused("no card answers on can0");`.
inline Outcome accepted() { return Outcome::accepted(); }
inline Outcome refused(std::string_view reason) { return Outcome::refused(reason); }

}  // namespace armature::component
