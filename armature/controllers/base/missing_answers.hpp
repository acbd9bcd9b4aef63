// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/component/author.hpp"
#include "armature/control/arming/gathering.hpp"

namespace armature::controllers {

/// A component's name as an event carries it.
using ComponentName = base::FixedText<63>;

/// Who writes `input`; the input's own name if nobody does.
std::string_view writer_of(const component::InputPortBase& input);

/// What an operator sees of those who did not answer in a round, and when it is too much. Part of a
/// component that has a control::Gathering.
class MissingAnswers {
 public:
  explicit MissingAnswers(component::Component* owner);

  int max_missing() const { return max_missing_; }
  /// The property, for Changes.
  component::Property<int>& limit() { return max_missing_; }

  /// Makes room for the counts of `members`.
  /// @thread configuration only
  void resize(std::size_t members);
  /// Counts from 0 again.
  /// @rt nonblocking, no allocation, O(members)
  void reset();

  /// Counts and names who was missing in the round that ended, if anybody was.
  /// @param name_of  of a member, `std::string_view (std::size_t)`
  /// @return true if one was missing that had answered in the round before: worth a log line
  /// @rt nonblocking, no allocation, O(members)
  template <typename NameOf>
  bool note(const control::Gathering& gathering, const NameOf& name_of) {
    begin_note();
    bool news = false;
    for (std::size_t i = 0; i < gathering.members(); ++i) {
      counts_[i] = gathering.missing_ever(i);
      if (gathering.missing_in_row(i) == 0) continue;
      news = news || gathering.missing_in_row(i) == 1;
      add_name(name_of(i));
    }
    end_note();
    return news;
  }
  std::string_view names() const { return names_.get(); }

  /// Raises `Missing`.
  /// @param number  of the member, from 1
  /// @return the reason for a fault that names it
  /// @rt nonblocking, no allocation
  component::Reason give_up(std::size_t number, std::string_view name, int rounds);

 private:
  void begin_note();
  void add_name(std::string_view name);
  void end_note();

  component::Property<int> max_missing_;
  component::Attribute<int> incomplete_;
  component::Attribute<std::vector<int>> missing_;
  component::Attribute<component::Reason> names_;
  component::Event<int, ComponentName> event_;

  std::vector<int> counts_;
  component::Reason text_;
};

}  // namespace armature::controllers
