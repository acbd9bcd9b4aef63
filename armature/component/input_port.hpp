// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/component/entrance.hpp"
#include "armature/component/internal/channel.hpp"
#include "armature/component/port.hpp"
#include "armature/component/signature.hpp"
#include "armature/rt/inbox.hpp"

namespace armature::component {

/// What a read found, and the value; `value` refers into the port until the next read, and in a
/// handler or hook until that ends.
template <typename T>
struct Reading {
  ReadStatus status;
  bool stale;  ///< older than the port's declared age
  const T& value;
  base::Time time;  ///< when it was written

  /// There is a value, and it is not stale.
  explicit operator bool() const { return status >= ReadStatus::kOld && !stale; }
  bool is_new() const { return status == ReadStatus::kNew; }
};

/// What losses an input saw.
struct InputCounters {
  std::uint64_t missed = 0;  ///< values that were overwritten or dropped before they were read
  std::uint64_t stale = 0;   ///< how often the data became older than declared
  std::uint64_t lost = 0;    ///< how often a writer faulted
};

class OutputPortBase;

class InputPortBase : public PortBase {
 public:
  bool triggers() const { return triggers_; }
  const LeadsTo& effects() const { return leads_to_; }
  bool allows_fan_in() const { return fan_in_; }
  bool connected() const { return !writers_.empty(); }
  const std::vector<OutputPortBase*>& writers() const { return writers_; }
  base::Duration max_age() const { return max_age_; }
  Reaction stale_reaction() const { return stale_reaction_; }
  Reaction lost_reaction() const { return lost_reaction_; }
  InputCounters counters() const { return counters_; }

  /// Declares an age from outside, as a deployment does for a connection.
  void set_max_age(MaxAge declared) { apply(declared); }
  void set_on_lost(OnLost declared) { apply(declared); }

  /// Reacts if the data is older than declared.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void check_age();

  /// When its data will be too old if nothing new comes; the end of time if it has no age, or is
  /// too old already. Its component runs.
  /// @thread the component's own
  base::Time expiry() const;

  /// A writer faulted: the reader's thread reacts as declared.
  /// @thread the writer's
  void tell_lost() { owner().context().raise(lost_); }

  /// The component starts: reactions to ages count from now.
  void begin();

  /// What was on its way to this port from another thread is gone with that thread.
  void forget_messages() { lost_.lower(); }

 protected:
  InputPortBase(Component& owner, std::string name, std::string_view doc, std::string_view unit,
                const types::Type& type);

  using PortBase::apply;
  void apply(MaxAge declared) {
    max_age_ = declared.age;
    stale_reaction_ = declared.reaction;
  }
  void apply(OnLost declared) { lost_reaction_ = declared.reaction; }
  void apply(FanIn) { fan_in_ = true; }
  void apply(const LeadsTo& effects) { leads_to_ = effects; }

  virtual void look_for_newer() = 0;

  bool is_stale(base::Time written) const {
    return max_age_ > base::Duration::zero() && owner().time() - written > max_age_;
  }
  bool reads_zero(bool stale) const {
    return zeroed_ || (stale && stale_reaction_ == Reaction::kZero);
  }

  Entrance entrance_;  ///< into the handler
  bool triggers_ = false;
  bool zeroed_ = false;  ///< its writer was lost, and nothing came since
  std::vector<OutputPortBase*> writers_;
  InputCounters counters_;

 private:
  struct Lost final : rt::Signal {
    explicit Lost(InputPortBase& port) : rt::Signal(&Lost::deliver), self(port) {}
    static void deliver(rt::Message& message);
    InputPortBase& self;
  };

  void react(Reaction reaction, std::string_view what);
  /// When the present data was written; waiting for the first counts from the start.
  base::Time written() const;

  bool fan_in_ = false;
  bool late_ = false;  ///< the reaction to old data happened
  LeadsTo leads_to_;
  Reaction stale_reaction_ = Reaction::kStop;
  Reaction lost_reaction_ = Reaction::kStop;
  base::Duration max_age_{};
  base::Time started_{};
  Lost lost_;
};

/// Option of an input port: a write runs `Handler`, a member function of the component that takes
/// nothing, the value, or the port's index in its array and the value. What arrives while the
/// component does not run triggers nothing, and can be read later.
template <auto Handler>
struct OnData {};
template <auto Handler>
inline constexpr OnData<Handler> on_data{};

/// Option of an input port: a write runs the component's update.
struct OnDataUpdate {};
inline constexpr OnDataUpdate on_data_update{};

/// Reads what is written to it, wait-free, from this thread or another.
template <typename T>
class InputPort final : public InputPortBase {
  static_assert(PortData<T>, ARMATURE_INTERNAL_PORT_DATA_TEXT);

 public:
  /// Name, documentation and unit are literals. Options: on_data<&X::f>, on_data_update, max_age,
  /// on_lost, may_stay_open, fan_in, size_of(property, factor).
  template <typename... Options>
  InputPort(Component* owner, std::string name, std::string_view doc, std::string_view unit = {},
            Options... options)
      : InputPortBase(*owner, std::move(name), doc, unit, types::type_of<T>()) {
    (apply(options), ...);
    owner->declare().inputs.push_back(this);
  }
  ~InputPort() override {
    for (OutputPortBase* writer : writers_) internal::forget_reader(*writer, *this);
  }

  /// The newest value (of a FIFO: the next), and whether it is new, was read before, was never
  /// written, or can never come because nothing is connected.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  Reading<T> read() {
    if (!channels_.empty() && !triggers_ && !std::exchange(looked_ahead_, false)) pull();
    const Sample<T>& sample = *source_;
    const ReadStatus status = status_of(sample);
    const bool stale = is_stale(sample.time);
    const bool empty = status < ReadStatus::kOld || reads_zero(stale);
    unread_ = false;
    return {status, stale, empty ? empty_.value : sample.value, sample.time};
  }

  /// The port's place in its array, from 0.
  std::size_t index() const { return index_; }
  void set_index(std::size_t index) { index_ = index; }

  const void* current() const override { return &source_->value; }
  base::Time current_time() const override { return source_->time; }
  std::uint64_t current_sequence() const override { return source_->sequence; }

  // --- for the output port that is connected ---------------------------------------------------
  void connect_source(OutputPortBase& writer, const Sample<T>& source) {
    source_ = &source;
    seen_ = source.sequence == 0 ? 0 : source.sequence - 1;
    writers_.push_back(&writer);
  }
  internal::Channel<T>& connect_channel(OutputPortBase& writer,
                                        std::unique_ptr<internal::Channel<T>> channel) {
    channel->writer = &writer;
    writers_.push_back(&writer);
    channels_.push_back(std::move(channel));
    return *channels_.back();
  }
  void disconnect(OutputPortBase& writer) {
    std::erase(writers_, &writer);
    std::erase_if(channels_, [&writer](const auto& each) { return each->writer == &writer; });
    next_channel_ = 0;
    source_ = &empty_;
    seen_ = 0;
    unread_ = false;
    looked_ahead_ = false;
  }
  /// Zeros in the shape of `shape`: what is read before the first write.
  void set_shape(const T& shape) {
    empty_.value = T(shape);
    internal::set_to_zero(type(), &empty_.value);
  }

  /// A sample was written in this thread to the place that this port reads.
  void arrived() {
    zeroed_ = false;
    dispatch();
  }
  /// Takes what `channel` holds, one handler call for each sample.
  void drain(internal::Channel<T>& channel) {
    while (const Sample<T>* sample = channel.pop()) {
      take(channel, *sample);
      dispatch();
    }
  }

 private:
  using Dispatch = void (*)(Component&, InputPort&);

  using InputPortBase::apply;
  template <auto Handler>
  void apply(OnData<Handler>) {
    triggers_ = true;
    dispatch_ = [](Component& component, InputPort& port) {
      using Owner = typename internal::MemberOf<decltype(Handler)>::Owner;
      call<Handler>(static_cast<Owner&>(component), port);
    };
  }
  void apply(OnDataUpdate) { triggers_ = true; }

  template <auto Handler, typename Owner>
  static void call(Owner& owner, InputPort& port) {
    if constexpr (std::is_invocable_v<decltype(Handler), Owner&>) {
      (owner.*Handler)();
    } else if constexpr (std::is_invocable_v<decltype(Handler), Owner&, const T&>) {
      (owner.*Handler)(port.take_value());
    } else {
      static_assert(std::is_invocable_v<decltype(Handler), Owner&, std::size_t, const T&>,
                    "a handler of an input port takes (), (value) or (index, value)");
      (owner.*Handler)(port.index_, port.take_value());
    }
  }

  const T& take_value() {
    seen_ = source_->sequence;
    return reads_zero(is_stale(source_->time)) ? empty_.value : source_->value;
  }

  void dispatch() {
    Component& component = owner();
    ExecutionContext& context = component.context();
    if (dispatch_ == nullptr) {
      entrance_.pass(context, [&] { component.update(); });
      return;
    }
    if (max_age() > base::Duration::zero()) check_age();
    if (!component.admits()) return;
    entrance_.pass(context, [&] { component.run(context, [&] { dispatch_(component, *this); }); });
  }

  ReadStatus status_of(const Sample<T>& sample) {
    if (sample.sequence == 0) {
      return connected() ? ReadStatus::kNone : ReadStatus::kNotConnected;
    }
    if (sample.sequence == seen_) return ReadStatus::kOld;
    counters_.missed += sample.sequence - seen_ - 1;
    seen_ = sample.sequence;
    zeroed_ = false;
    return ReadStatus::kNew;
  }

  /// Takes the next sample of the channels, in turn; the channel it came from, or nullptr.
  internal::Channel<T>* pull() {
    for (std::size_t tried = 0; tried < channels_.size(); ++tried) {
      internal::Channel<T>& channel = *channels_[next_channel_];
      if (++next_channel_ == channels_.size()) next_channel_ = 0;
      if (const Sample<T>* sample = channel.pop()) {
        take(channel, *sample);
        return &channel;
      }
    }
    return nullptr;
  }

  void take(internal::Channel<T>& channel, const Sample<T>& sample) {
    counters_.missed += sample.sequence - channel.last_sequence - (unread_ ? 0 : 1);
    unread_ = !triggers_;
    channel.last_sequence = sample.sequence;
    source_ = &sample;
    seen_ = sample.sequence - 1;
    zeroed_ = false;
  }

  /// A FIFO's next sample is not passed over: it is the one to be read next.
  void look_for_newer() override {
    if (triggers_ || channels_.empty() || looked_ahead_) return;
    const internal::Channel<T>* const channel = pull();
    looked_ahead_ = channel != nullptr && channel->keeps_all();
  }

  Dispatch dispatch_ = nullptr;
  Sample<T> empty_{};
  const Sample<T>* source_ = &empty_;
  std::uint64_t seen_ = 0;
  std::vector<std::unique_ptr<internal::Channel<T>>> channels_;
  std::size_t next_channel_ = 0;
  std::size_t index_ = 0;
  bool unread_ = false;        ///< what was taken from a channel last was not read
  bool looked_ahead_ = false;  ///< and is to be read before the next is taken
};

}  // namespace armature::component
