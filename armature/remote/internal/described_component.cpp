// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/internal/described_component.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "armature/base/quoted.hpp"
#include "armature/remote/internal/idl_types.hpp"
#include "armature/types/elements.hpp"
#include "idl/canonical.hpp"

namespace armature::remote::internal {
namespace {

using Kind = NumberedMember::Kind;
using component::Signature;

ride::Access access_of(idl::Access access) {
  switch (access) {
    case idl::Access::kRead:
      return ride::Access::kRead;
    case idl::Access::kConfigure:
      return ride::Access::kConfigure;
    case idl::Access::kCommand:
      break;
  }
  return ride::Access::kCommand;
}

bool is_single(const idl::Type& type, idl::Basic basic) {
  return type.form == idl::Type::Form::kSingle && type.basic == basic;
}

/// `void NAME(TYPE value)`: docs/remote.md, "On the wire".
bool is_input(const idl::Operation& operation) {
  return operation.is_command() && operation.parameters.size() == 1 &&
         operation.parameters.front().name == "value";
}

/// `event NAME { unsigned long sequence; long time; TYPE value; }`
bool is_output(const idl::Structure& event) {
  const std::vector<idl::Field>& members = event.members;
  return members.size() == 3 && members[0].name == "sequence" && members[1].name == "time" &&
         members[2].name == "value" && is_single(members[0].type, idl::Basic::kUnsignedLong) &&
         is_single(members[1].type, idl::Basic::kLong);
}

/// `NAME` in `void cancel_NAME()`; empty if it is something else.
std::string cancelled_by(const idl::Operation& operation) {
  constexpr std::string_view kCancel = "cancel_";
  if (!operation.is_command() || !operation.parameters.empty()) return {};
  return operation.name.starts_with(kCancel) ? operation.name.substr(kCancel.size()) : "";
}

/// `NAME` in `event NAME_progress { double progress; }`; empty if it is something else.
std::string with_progress(const idl::Structure& event) {
  constexpr std::string_view kProgress = "_progress";
  if (event.members.size() != 1 || !is_single(event.members[0].type, idl::Basic::kDouble)) {
    return {};
  }
  if (!event.name.ends_with(kProgress)) return {};
  return event.name.substr(0, event.name.size() - kProgress.size());
}

/// Goes through an interface, and adds what it declares to a component.
class Describer {
 public:
  using Found = base::Result<const types::Type*>;
  using Rule = Found (IdlTypes::*)(const idl::Type&) const;

  Describer(const std::string& name, const idl::Program& program, const idl::Interface& interface,
            base::Diagnostics& diagnostics)
      : program_(program),
        interface_(interface),
        diagnostics_(diagnostics),
        types_(program),
        made_(std::make_unique<DescribedComponent>(name)) {}

  std::unique_ptr<DescribedComponent> describe() {
    // Commands first: their companions refer to them.
    for (const idl::Operation& operation : interface_.operations) {
      if (command_of(operation) == nullptr) add(operation);
    }
    for (const idl::Operation& operation : interface_.operations) {
      if (const idl::Operation* const command = command_of(operation)) {
        declare_cancel(operation, *command);
      }
    }
    for (const idl::EventName& name : interface_.events) add(*program_.find_event(name.name));
    made_->numbers = std::make_unique<InterfaceNumbers>(interface_.name, declarations_);
    return std::move(made_);
  }

 private:
  using Member = std::optional<NumberedMember>;

  static Member member(Kind kind, std::size_t index) {
    return NumberedMember{.number = 0, .kind = kind, .index = index};
  }

  void declare(const idl::Operation& operation, Member member) {
    if (member) member->priority = {operation.priority};
    declarations_.push_back(
        {idl::canonical(program_, operation), access_of(operation.access), member});
  }

  /// It has the priority of its command, which it never overtakes.
  void declare_cancel(const idl::Operation& operation, const idl::Operation& command) {
    Member cancel;
    if (const auto place = place_of_command(command.name)) cancel = member(Kind::kCancel, *place);
    if (cancel) cancel->priority = {command.priority};
    declarations_.push_back(
        {idl::canonical(program_, operation), access_of(operation.access), cancel});
  }

  /// The command that it cancels; nullptr if it is none of its own.
  const idl::Operation* command_of(const idl::Operation& operation) const {
    const std::string name = cancelled_by(operation);
    const auto found = std::ranges::find_if(interface_.operations, [&](const auto& each) {
      return each.name == name && each.is_command() && !is_input(each);
    });
    return found == interface_.operations.end() ? nullptr : &*found;
  }
  std::optional<std::size_t> place_of_command(const std::string& name) const {
    const auto& operations = component::interface_of(*made_).operations;
    const auto found = std::ranges::find_if(
        operations, [&](const auto* each) { return each->is_command() && each->name() == name; });
    if (found == operations.end()) return std::nullopt;
    return static_cast<std::size_t>(found - operations.begin());
  }

  void add(const idl::Operation& operation) {
    what_ = "operation " + base::quoted(operation.name);
    if (!claim(operation.name, operation.where)) return declare(operation, std::nullopt);
    if (is_input(operation)) return declare(operation, add_input(operation));
    const bool is_command = operation.is_command();
    auto signature = signature_of(operation.parameters, operation.where,
                                  is_command ? &IdlTypes::of_command : &IdlTypes::of_request);
    if (signature && !is_command) {
      signature->result = here(operation.where, types_.of_request(operation.result));
      if (signature->result == nullptr) signature.reset();
    }
    if (!signature) return declare(operation, std::nullopt);
    const std::string_view name = made_->keep(operation.name);
    const std::string_view doc = made_->keep(to_text(operation.doc));
    declare(operation,
            is_command
                ? member(Kind::kCommand, made_->add_command(name, doc, std::move(*signature)))
                : member(Kind::kOperation, made_->add_operation(name, doc, std::move(*signature))));
  }

  Member add_input(const idl::Operation& operation) {
    const idl::Field& value = operation.parameters.front();
    const types::Type* const type = here(operation.where, types_.of_command(value.type));
    if (type == nullptr) return std::nullopt;
    return member(Kind::kInput,
                  made_->add_input({operation.name, made_->keep(to_text(operation.doc)),
                                    made_->keep(value.unit), *type}));
  }

  void add(const idl::Structure& event) {
    what_ = "event " + base::quoted(event.name);
    const auto command = place_of_command(with_progress(event));
    Member member;
    if (command) {
      member = Describer::member(Kind::kProgress, *command);
    } else if (claim(event.name, event.where)) {
      member = is_output(event) ? add_output(event) : add_event(event);
    }
    declarations_.push_back({idl::canonical(program_, event), ride::Access::kRead, member});
  }

  Member add_output(const idl::Structure& event) {
    const idl::Field& value = event.members.back();
    const types::Type* const type = here(event.where, types_.of_fixed_size(value.type));
    if (type == nullptr) return std::nullopt;
    Member output =
        member(Kind::kOutput, made_->add_output({event.name, made_->keep(to_text(event.doc)),
                                                 made_->keep(value.unit), *type}));
    add_ranges(value, *type, {0, 0}, output->ranges);
    return output;
  }

  Member add_event(const idl::Structure& event) {
    auto signature = signature_of(event.members, event.where, &IdlTypes::of_fixed_size);
    if (!signature) return std::nullopt;
    std::vector<ValueRange> ranges;
    for (std::size_t i = 0; i < event.members.size(); ++i) {
      signature->arguments[i].by_reference = false;
      add_ranges(event.members[i], *signature->arguments[i].type, {i, 0}, ranges);
    }
    Member added = member(Kind::kEvent,
                          made_->add_event(made_->keep(event.name), made_->keep(to_text(event.doc)),
                                           std::move(*signature)));
    added->ranges = std::move(ranges);
    return added;
  }

  /// Where a member of an event, or of a struct in it, is.
  struct Place {
    std::size_t argument;
    std::size_t offset;
  };

  /// The ranges of a member and of the structs in it.
  void add_ranges(const idl::Field& field, const types::Type& type, const Place& place,
                  std::vector<ValueRange>& to) const {
    const types::Type& one = types::is_list(type) ? *type.element : type;
    const std::size_t count = types::is_list(type) ? type.count : 1;
    if (field.range) {
      ValueRange range{place.argument, place.offset, count, types::Value(one), types::Value(one)};
      const bool read = types::from_text(one, field.range->low, range.low.data()) &&
                        types::from_text(one, field.range->high, range.high.data());
      if (read) to.push_back(std::move(range));  // always: the file has no mistake
    }
    if (one.kind != types::Kind::kStruct) return;
    const std::vector<idl::Field>& members = program_.find_struct(one.name)->members;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t m = 0; m < members.size(); ++m) {
        const std::size_t offset = place.offset + i * one.size + one.fields[m].offset;
        add_ranges(members[m], *one.fields[m].type, {place.argument, offset}, to);
      }
    }
  }

  /// Nothing if one of the types cannot be here.
  std::optional<Signature> signature_of(const std::vector<idl::Field>& fields,
                                        const base::Location& where, Rule rule) {
    Signature signature;
    for (const idl::Field& field : fields) {
      const types::Type* const type = here(where, (types_.*rule)(field.type));
      if (type == nullptr) return std::nullopt;
      const std::string unit = field.unit.empty() ? "" : " [" + field.unit + "]";
      signature.arguments.push_back(
          {made_->keep(field.name + unit), type, !types::is_scalar(*type)});
    }
    return signature;
  }

  /// nullptr after a note that says why it cannot be here.
  const types::Type* here(const base::Location& where, const Found& type) {
    if (type) return type.value();
    leave_out(where, type.error());
    return nullptr;
  }

  /// Two members of one name cannot be told apart, whatever they are.
  bool claim(const std::string& name, const base::Location& where) {
    const bool of_a_placeholder = name == "PeerFound" || name == "PeerLost";
    if (!of_a_placeholder && names_.insert(name).second) return true;
    leave_out(where, "the component has another member of this name");
    return false;
  }

  void leave_out(const base::Location& where, const std::string& why) {
    diagnostics_.note(
        where, what_ + " of interface " + base::quoted(interface_.name) + " is left out: " + why);
  }

  const idl::Program& program_;
  const idl::Interface& interface_;
  base::Diagnostics& diagnostics_;
  IdlTypes types_;
  std::unique_ptr<DescribedComponent> made_;
  std::vector<DescribedDeclaration> declarations_;
  std::set<std::string> names_;
  std::string what_;  ///< that is added, for notes
};

}  // namespace

std::unique_ptr<DescribedComponent> describe(const std::string& name, const idl::Program& program,
                                             const idl::Interface& interface,
                                             base::Diagnostics& diagnostics) {
  return Describer(name, program, interface, diagnostics).describe();
}

}  // namespace armature::remote::internal
