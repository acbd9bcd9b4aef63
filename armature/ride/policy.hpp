// SPDX-License-Identifier: Apache-2.0
#pragma once

// Who may do what, from a text file; docs/security.md has the format.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/ride/node.hpp"

namespace armature::ride {

/// A line of a policy file: `allow operator@tls read,command Vision`.
struct PolicyRule {
  std::string who;                      ///< as `who` has it, `*@tls` for all of a transport, or `*`
  std::array<bool, 3> access{};         ///< by Access
  std::vector<std::string> components;  ///< their names, or one `*`
  base::Location where;                 ///< of the first component's name

  bool covers(Access asked) const { return access[static_cast<std::size_t>(asked)]; }
};

/// What is allowed by any of its rules, in whatever order, is allowed; nothing else is.
/// @thread any
class Policy {
 public:
  /// @param file  the name for diagnostics; each mistake has its line and column
  /// @return without any rule after an error, so that it allows nothing
  static Policy parse(std::string_view text, const std::string& file,
                      base::Diagnostics& diagnostics);
  /// The same from a file.
  static Policy load(const std::string& path, base::Diagnostics& diagnostics);

  /// For NodeOptions::allows: `options.allows = [policy](const auto& q) { return policy.allows(q);
  /// }`
  bool allows(const AccessQuestion& question) const;
  /// Warns of rules that speak of a component which is none of `components`.
  void check(const std::vector<std::string>& components, base::Diagnostics& diagnostics) const;

  /// What `other` allows is allowed, too.
  void add(const Policy& other);

  const std::vector<PolicyRule>& rules() const { return rules_; }
  /// As a file.
  std::string to_text() const;

 private:
  std::vector<PolicyRule> rules_;
};

}  // namespace armature::ride
