// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/replay/recorded_channels.hpp"

namespace armature::replay {

/// Samples of an output of a component, as a recording has them.
struct RecordedOutput {
  std::string port;
  const ChannelSamples* channel = nullptr;  ///< outlives the component
  /// They are not written when the component's cycle comes, or something to it, but when it is told
  /// to play.
  bool when_told = false;
};

/// Stands for a component of a recorded run that does not run again: at the times at which that one
/// wrote, it writes the same. Nobody may call it.
class RecordedComponent final : public component::StandIn {
 public:
  /// @param original  has the members, and never runs
  explicit RecordedComponent(std::unique_ptr<component::Component> original);
  ~RecordedComponent() override;

  /// Has an output write samples; the error says why they do not fit.
  /// @thread configuration only
  base::Result<void> add(RecordedOutput output);

  /// When it has something to write next; the end of time if there is nothing more.
  base::Time next() const;
  /// Writes what is due by its time; while it does not run, that is left out.
  /// @thread the component's own
  void play();

  void pass_on(component::InputPortBase& input, const void* value) override;
  component::CallStatus call(component::OperationBase& operation, const void* const* arguments,
                             void* result) override;
  component::Outcome begin(component::CommandBase& command, const void* const* arguments) override;
  void cancel(component::CommandBase& command) override;

 private:
  struct Playing {
    component::OutputPortBase* port;
    RecordedOutput recorded;
    std::size_t next = 0;
    bool by_itself() const { return !recorded.when_told; }
  };

  void on_update() override;
  template <typename Chosen>
  void play_those(const Chosen& chosen);
  base::Time next_of(const Playing& one) const;
  void write(Playing& one, const record::RecordedSample& sample);

  const std::unique_ptr<component::Component> original_;
  std::vector<std::unique_ptr<component::OutputPortBase>> outputs_;
  std::vector<std::unique_ptr<component::InputPortBase>> inputs_;
  std::vector<std::unique_ptr<component::OperationBase>> operations_;
  std::vector<std::unique_ptr<component::EventBase>> events_;
  std::vector<Playing> playing_;
};

}  // namespace armature::replay
