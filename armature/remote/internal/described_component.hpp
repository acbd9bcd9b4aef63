// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/component/author.hpp"
#include "armature/component/described.hpp"
#include "armature/remote/interface_numbers.hpp"
#include "idl/model.hpp"

namespace armature::remote::internal {

/// A component that is known by an interface file: what it has, and how that is called on the wire.
/// It never runs: a placeholder stands for it.
class DescribedComponent final : public component::Component {
 public:
  using Component::Component;

  /// Keeps a text as long as the component lives.
  std::string_view keep(std::string text) { return texts_.emplace_back(std::move(text)); }

  /// Each returns the member's place among those of its kind.
  std::size_t add_operation(std::string_view name, std::string_view doc,
                            component::Signature signature) {
    operations_.push_back(
        std::make_unique<component::DescribedOperation>(*this, name, doc, std::move(signature)));
    return operations_.size() - 1;
  }
  std::size_t add_command(std::string_view name, std::string_view doc,
                          component::Signature signature) {
    operations_.push_back(
        std::make_unique<component::DescribedCommand>(*this, name, doc, std::move(signature)));
    return operations_.size() - 1;
  }
  std::size_t add_event(std::string_view name, std::string_view doc,
                        component::Signature signature) {
    events_.push_back(
        std::make_unique<component::DescribedEvent>(*this, name, doc, std::move(signature)));
    return events_.size() - 1;
  }
  std::size_t add_input(const component::DescribedPort& port) {
    inputs_.push_back(std::make_unique<component::DescribedInput>(*this, port));
    return inputs_.size() - 1;
  }
  std::size_t add_output(const component::DescribedPort& port) {
    outputs_.push_back(std::make_unique<component::DescribedOutput>(*this, port));
    return outputs_.size() - 1;
  }

  /// How its members are called; who stands for it takes them.
  std::unique_ptr<InterfaceNumbers> numbers;

 private:
  std::deque<std::string> texts_;
  std::vector<std::unique_ptr<component::OperationBase>> operations_;
  std::vector<std::unique_ptr<component::EventBase>> events_;
  std::vector<std::unique_ptr<component::InputPortBase>> inputs_;
  std::vector<std::unique_ptr<component::OutputPortBase>> outputs_;
};

/// Makes one of an interface.
/// @param interface    of `program`, which was loaded without mistakes
/// @param diagnostics  gets a note for each declaration that cannot be here, and is left out
std::unique_ptr<DescribedComponent> describe(const std::string& name, const idl::Program& program,
                                             const idl::Interface& interface,
                                             base::Diagnostics& diagnostics);

}  // namespace armature::remote::internal
