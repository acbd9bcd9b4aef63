// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/component/operations/call_parameters.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/deploy/internal/components.hpp"
#include "armature/document/document.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/exec/blueprint.hpp"

namespace armature::deploy::internal {

using namespace document;

/// How messages name an end.
inline std::string path(const Endpoint& end) { return in_quotes(to_text(end)); }

/// What is called and is to have parameters.
struct Called {
  const Endpoint& to;
  const component::Signature& signature;
  const std::vector<Property>& with;  ///< as the deployment says
  const base::Location& where;
  std::string prefix{};                         ///< of the inputs that are made for ports
  const Endpoint* on = nullptr;                 ///< an event that may give some; nullptr: none
  const component::Signature* event = nullptr;  ///< its members
};

/// `position [rad]` is `position`, in rad.
struct NameAndUnit {
  std::string name;
  std::string unit;
};

/// Finds what gives the parameters of a call, and whether it fits.
class ParameterBuilder {
 public:
  using Parameter = component::CallParameter;

  ParameterBuilder(const Components& components, base::Diagnostics& diagnostics)
      : components_(components), diagnostics_(diagnostics) {}

  /// Nothing if a mistake was told.
  std::optional<std::vector<Parameter>> parameters(const Called& called);

 private:
  /// What is given for a parameter, as messages name it, and what to do if it does not fit.
  struct Offer {
    std::string what;
    const types::Type& type;
    std::string unit;
    base::Location where;
    const char* hint;
  };

  bool check_names(const Called& called);
  std::optional<Parameter> parameter(const Called& called, std::size_t index);
  std::optional<Parameter> of_event(const Called& called, std::size_t index);
  std::optional<Parameter> given(const Called& called, std::size_t index, const Property& written);
  std::optional<Parameter> from_member(const Called& called, std::size_t index, std::size_t member,
                                       const base::Location& where);
  std::optional<Parameter> from_port(const Called& called, std::size_t index, const Value& written);
  bool fits(const Called& called, std::size_t index, const Offer& offer);
  NameAndUnit wanted_argument(const Called& called, std::size_t index) const;

  const Components& components_;
  base::Diagnostics& diagnostics_;
};

/// Connects the ports that parameters come from with the inputs of `user` that are made for them.
/// @param keeps_running  also without who writes the port
void connect_parameters(const std::vector<component::CallParameter>& parameters,
                        const std::string& user, bool keeps_running, const base::Location& where,
                        exec::Blueprint& blueprint);

}  // namespace armature::deploy::internal
