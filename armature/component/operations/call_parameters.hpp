// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"
#include "armature/component/operations/signature.hpp"
#include "armature/component/outcome.hpp"
#include "armature/component/untyped.hpp"
#include "armature/types/type.hpp"

namespace armature::component {

/// Where one parameter of a command or an operation comes from, as a deployment says.
struct CallParameter {
  /// Which of the members below counts.
  enum class From { kMember, kPort, kConstant };
  From from = From::kMember;
  std::size_t member = 0;                          ///< of the event
  std::string input;                               ///< its name, for a port
  const OutputPortBase* port = nullptr;            ///< whose latest value it is
  std::shared_ptr<const types::Value> constant{};  ///< of the parameter's type
};

/// The parameters of a call of any signature, with an input for each that comes from a port.
class CallParameters {
 public:
  /// @param owner   of the inputs
  /// @param called  what takes the parameters, one for each argument
  /// @param event   whose members some of them are; nullptr: none are
  CallParameters(Component& owner, const Signature& called, const Signature* event,
                 std::vector<CallParameter> parameters);
  CallParameters(CallParameters&&) = default;

  const std::vector<CallParameter>& all() const { return parameters_; }
  /// True if a value of type `offered` can be a parameter: of the same type, or a number for a
  /// floating one.
  static bool takes(const types::Type& parameter, const types::Type& offered);

  /// Has `use` look at arguments of the shape that all will have; ports have theirs by now.
  /// @thread configuration only
  template <typename Use>
  void with_sample(const Use& use) {
    const std::vector<types::Value> members = sample_members();
    fill_sample(members);
    use(places());
  }

  /// Collects the values as they are now.
  /// @param members  of the event, where there is one
  /// @param max_age  of the values of ports at `now`; 0: any
  /// @return what is missing; empty if all are there
  /// @rt nonblocking, no allocation, O(parameters)
  Reason collect(const void* const* members, base::Time now, base::Duration max_age);
  /// Where they are since `collect`.
  const void* const* places() const { return places_.data(); }

 private:
  std::vector<types::Value> sample_members() const;
  void fill_sample(const std::vector<types::Value>& members);
  /// The value at `from` as the parameter takes it.
  const void* as_taken(std::size_t index, const void* from);

  /// A number of another type than the parameter's, which it becomes.
  struct Conversion {
    const types::Type* from = nullptr;  ///< nullptr: they are the same
    types::Value value;
  };

  const Signature* event_;
  std::vector<CallParameter> parameters_;
  std::vector<std::unique_ptr<UntypedInputPort>> inputs_;  ///< of each; nullptr: no port
  std::vector<Conversion> conversions_;                    ///< of each
  std::vector<const void*> places_;
};

}  // namespace armature::component
