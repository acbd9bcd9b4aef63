// SPDX-License-Identifier: Apache-2.0
#pragma once

// What ports keep apart from what every write and read touches.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/component/internal/channel.hpp"
#include "armature/component/internal/sample_form.hpp"
#include "armature/component/observing/tap.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/component/ports/port.hpp"
#include "armature/rt/inbox.hpp"

namespace armature::component {

struct PortBase::About {
  explicit About(const PortDeclaration& declaration);
  virtual ~About();

  std::string name;
  internal::SampleForm form;
  bool is_small;
  bool may_stay_open = false;
  std::string_view unit;
  const Property<std::string>* unit_property = nullptr;  ///< that says it instead
  PortSize size;
  std::string_view doc;
};

struct InputPortBase::Lost final : rt::Signal {
  explicit Lost(InputPortBase& port) : rt::Signal(&Lost::deliver), self(port) {}
  static void deliver(rt::Message& message);
  InputPortBase& self;
};

struct InputPortBase::About final : PortBase::About {
  About(InputPortBase& port, const PortDeclaration& declaration);
  ~About() override;

  const void* empty_value() const { return empty.get(); }

  internal::AnySample empty;  ///< zeros in the shape of what will be written; never written itself
  bool fan_in = false;
  bool turns = false;  ///< its writers take turns
  bool late = false;   ///< the reaction to old data happened
  LeadsTo leads_to;
  Reaction stale_reaction = Reaction::kStop;
  Reaction lost_reaction = Reaction::kStop;
  base::Duration max_age{};
  base::Time started{};
  std::vector<OutputPortBase*> writers;
  std::vector<std::unique_ptr<internal::Channel>> channels;
  std::size_t next_channel = 0;
  bool unread = false;        ///< what was taken from a channel last was not read
  bool looked_ahead = false;  ///< and is to be read before the next is taken
  InputCounters counters;
  Lost lost;
};

struct OutputPortBase::About final : PortBase::About {
  About(const PortDeclaration& declaration, void* held_sample);
  ~About() override;

  void* sample;  ///< that the port holds
  OutputCounters counters;
  std::vector<InputPortBase*> readers;
  std::vector<InputPortBase*> triggered;  ///< readers in this thread whose handlers run now
  std::vector<internal::Channel*> channels;
  std::vector<std::unique_ptr<AttachedTap>> taps;
  AttachedTap* first_attached = nullptr;
  const OutputPortBase* predecessor = nullptr;
};

}  // namespace armature::component
