// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/component/interface.hpp"
#include "armature/remote/value_range.hpp"
#include "armature/ride/interface.hpp"

namespace armature::remote {

/// What a number on the wire stands for.
struct NumberedMember {
  /// Which kind of member it is.
  enum class Kind : std::uint8_t {
    kOperation,
    kCommand,   ///< begins it; the answer to a request comes when it has ended
    kCancel,    ///< `void cancel_NAME()`
    kProgress,  ///< `event NAME_progress{double}`, 0..1 while it is under way
    kEvent,
    kOutput,  ///< `event NAME{unsigned long,long,TYPE}`: sequence, time [ns], value
    kInput,   ///< `void NAME(TYPE)`
  };
  ride::Number number;
  Kind kind;
  std::size_t index;          ///< among the operations, events, outputs or inputs of the component
  ride::Priority priority{};  ///< of its messages
  std::vector<ValueRange> ranges{};  ///< of what comes from there
};

/// A declaration of an interface that a file describes, and what it is here; nothing if it cannot
/// be here, so that it counts in the digest only.
struct DescribedDeclaration {
  std::string canonical;
  ride::Access access;
  std::optional<NumberedMember> member;  ///< its number follows from `canonical`
};

/// The interface of a component as others see it over RIDE (docs/remote.md): the same for whoever
/// has a component of that model, on either side.
class InterfaceNumbers {
 public:
  /// @param model  the interface's name
  InterfaceNumbers(std::string model, const component::Interface& interface);
  /// @param name  the interface's
  InterfaceNumbers(std::string name, const std::vector<DescribedDeclaration>& all);
  InterfaceNumbers(const InterfaceNumbers&) = delete;
  InterfaceNumbers& operator=(const InterfaceNumbers&) = delete;

  /// Lives as long as this.
  const ride::Interface& interface() const { return interface_; }
  const std::vector<NumberedMember>& members() const { return members_; }
  /// nullptr: nothing has that number
  const NumberedMember* find(ride::Number number) const;
  /// nullptr: nothing is there
  const NumberedMember* member(NumberedMember::Kind kind, std::size_t index) const;
  /// The number of what is there; 0: nothing is.
  ride::Number number(NumberedMember::Kind kind, std::size_t index) const;

 private:
  void add(std::string canonical, NumberedMember::Kind kind, std::size_t index, ride::Access access,
           ride::Priority priority = {});
  void refer_to_texts();

  std::string model_;
  std::vector<std::string> texts_;
  std::vector<ride::Declaration> declarations_;
  std::vector<NumberedMember> members_;
  ride::Interface interface_;
};

}  // namespace armature::remote
