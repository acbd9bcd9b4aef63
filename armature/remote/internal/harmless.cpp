// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/internal/harmless.hpp"

#include "armature/types/elements.hpp"

namespace armature::remote::internal {

std::string harmless(std::string_view text) {
  std::string safe;
  bool continued = false;  // the second byte of U+0080 to U+009F, which are control characters too
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    const bool moves =
        (code < 0x20 && c != '\n' && c != '\t') || code == 0x7f || (continued && code < 0xa0);
    continued = code == 0xc2;
    safe += moves ? '?' : c;
  }
  return safe;
}

void make_harmless(const types::Type& type, void* value) {
  types::visit_leaves(type, value,
                      [](const std::string&, const types::Type& leaf_type, const void* leaf) {
                        if (!types::is_text(leaf_type)) return;
                        const std::string text = harmless(leaf_type.text(leaf));
                        // It is a part of `value`, which may be changed.
                        leaf_type.set_text(const_cast<void*>(leaf), text);
                      });
}

}  // namespace armature::remote::internal
