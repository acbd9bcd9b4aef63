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
#include "armature/component/port.hpp"
#include "armature/component/signature.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/rt/inbox.hpp"

namespace armature::component {

namespace internal {
class ChannelBase;
template <typename T>
class Channel;
}  // namespace internal

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
template <typename T>
class OutputPort;

/// Option of an input port: a write runs the component's update.
struct OnDataUpdate {};
inline constexpr OnDataUpdate on_data_update{};

/// What input ports of all types have in common.
class InputPortBase : public PortBase {
 public:
  ~InputPortBase() override;

  bool triggers() const { return triggers_; }
  const LeadsTo& effects() const { return about().leads_to; }
  bool allows_fan_in() const { return about().fan_in; }
  bool connected() const { return !about().writers.empty(); }
  const std::vector<OutputPortBase*>& writers() const { return about().writers; }
  bool ages() const { return about().max_age > base::Duration::zero(); }
  base::Duration max_age() const { return about().max_age; }
  Reaction stale_reaction() const { return about().stale_reaction; }
  Reaction lost_reaction() const { return about().lost_reaction; }
  InputCounters counters() const { return about().counters; }

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

  /// Until then its data is not too old, whatever comes; any past time if that is not known.
  /// @thread the component's own
  base::Time age_holds_until() const;

  /// A writer faulted: the reader's thread reacts as declared.
  /// @thread the writer's
  void tell_lost() { owner().context().raise(about().lost); }

  /// Its component runs, and no ages have to be looked at, or not for some time.
  void set_at_once(bool on) {
    set(kRests, !on);
    set(kAges, !on && ages());
  }

  /// The component starts: reactions to ages count from now.
  void begin();

  /// What was on its way to this port from another thread is gone with that thread.
  void forget_messages() { about().lost.lower(); }

  /// The port's place in its array, from 0.
  std::size_t index() const { return index_; }
  void set_index(std::size_t index) { index_ = static_cast<std::uint32_t>(index); }

  std::string_view handler() const final { return name(); }
  const Entrance* outer() const final { return outer_; }

  // --- for the output port that is connected ---------------------------------------------------
  void connect_channel(OutputPortBase& writer, std::unique_ptr<internal::ChannelBase> channel);
  /// Several writers will be connected, which take turns: one runs, the others do not. What the
  /// last one wrote stays until the next one writes.
  /// @thread configuration only, before they are connected
  void let_writers_take_turns() { about().turns = true; }
  bool writers_take_turns() const { return about().turns; }
  virtual void disconnect(OutputPortBase& writer) = 0;
  /// A sample was written in this thread to the place that this port reads; for a component that
  /// calls out (see Component::call_out).
  /// @param where  the context of both
  void arrived(ExecutionContext& where) noexcept { arrived_(*this, where); }
  /// Takes what `channel` holds, one handler call for each sample.
  virtual void drain(internal::ChannelBase& channel) = 0;

  /// An input of the same name and type, whose values `owner` passes on; it keeps what this one is
  /// made of, which outlives it.
  /// @thread configuration only
  virtual std::unique_ptr<InputPortBase> twin(StandIn& owner) const = 0;
  /// An output of `owner` of the same type: for who writes this input from elsewhere. It keeps what
  /// this one is made of, which outlives it.
  /// @thread configuration only
  virtual std::unique_ptr<OutputPortBase> make_writer(Component& owner,
                                                      std::string_view name) const = 0;

 protected:
  using Arrived = void (*)(InputPortBase&, ExecutionContext&) noexcept;

  /// The message that the writer has faulted.
  struct Lost final : rt::Signal {
    explicit Lost(InputPortBase& port) : rt::Signal(&Lost::deliver), self(port) {}
    static void deliver(rt::Message& message);
    InputPortBase& self;
  };

  /// Description, counters and lists, apart from what a cycle touches.
  struct About : PortBase::About {
    About(InputPortBase& port, std::string_view port_name, std::string_view port_doc,
          std::string_view port_unit, const types::Type& port_type);
    ~About() override;

    bool fan_in = false;
    bool turns = false;  ///< its writers take turns
    bool late = false;   ///< the reaction to old data happened
    LeadsTo leads_to;
    Reaction stale_reaction = Reaction::kStop;
    Reaction lost_reaction = Reaction::kStop;
    base::Duration max_age{};
    base::Time started{};
    std::vector<OutputPortBase*> writers;
    std::vector<std::unique_ptr<internal::ChannelBase>> channels;
    std::size_t next_channel = 0;
    bool unread = false;        ///< what was taken from a channel last was not read
    bool looked_ahead = false;  ///< and is to be read before the next is taken
    InputCounters counters;
    Lost lost;
  };

  InputPortBase(Component& owner, std::unique_ptr<About> about) noexcept;

  using PortBase::apply;
  void apply(MaxAge declared) noexcept;
  void apply(OnLost declared) noexcept { about().lost_reaction = declared.reaction; }
  void apply(FanIn) noexcept { about().fan_in = true; }
  void apply(const LeadsTo& effects) noexcept { about().leads_to = effects; }
  void apply(OnDataUpdate) noexcept;
  /// What its twin has of this one besides name and type.
  void mark_twin(InputPortBase& twin) const;

  /// `writer` and its channels are no more.
  void forget_writer(OutputPortBase& writer);
  /// The next sample was taken from `channel`.
  void note_taken(internal::ChannelBase& channel, std::uint64_t sequence);
  bool has_running_writer() const;
  virtual void look_for_newer() = 0;

  ReadStatus status_of(std::uint64_t sequence) {
    if (sequence == seen_) [[unlikely]] {
      if (sequence != 0) return ReadStatus::kOld;
      return connected() ? ReadStatus::kNone : ReadStatus::kNotConnected;
    }
    const std::uint64_t missed = sequence - seen_ - 1;
    if (missed != 0) [[unlikely]]
      about().counters.missed += missed;
    seen_ = sequence;
    return ReadStatus::kNew;
  }

  template <typename Code>
  void pass(ExecutionContext& where, Code&& code) noexcept {
    if (inside_ != 0) return refuse(where);
    inside_ = 1;
    owner().enter_handler(where, *this, outer_, code);
    inside_ = 0;
  }

  About& about() const { return static_cast<About&>(PortBase::about()); }
  bool is_stale(base::Time written) const {
    return has(kAges) && owner().time() - written > about().max_age;
  }
  bool reads_zero(bool stale) const {
    return has(kZeroed) || (stale && about().stale_reaction == Reaction::kZero);
  }

  /// What makes a port less simple than most; all of it in one byte, so that one look tells.
  enum Special : std::uint8_t {
    kAges = 1,    ///< a maximum age is declared and has to be looked at
    kZeroed = 2,  ///< its writer was lost, and nothing came since
    kPulls = 4,   ///< a read takes from channels
    kRests = 8,   ///< its component does not run, or looks at ages first
  };
  bool is_special() const { return special_ != 0; }
  /// Its handler may run without a further look.
  bool is_simple() const { return (special_ | inside_) == 0; }
  bool has(Special what) const { return (special_ & what) != 0; }
  void set(Special what, bool on) {
    special_ = static_cast<std::uint8_t>(on ? special_ | what : special_ & ~what);
  }

  const Entrance* outer_ = nullptr;
  bool triggers_ = false;
  std::uint8_t inside_ = 0;  ///< 1 while its handler runs

 private:
  void react(Reaction reaction, std::string_view what);
  /// When the present data was written; waiting for the first counts from the start.
  base::Time written() const;

  std::uint8_t special_ = kRests;
  std::uint32_t index_ = 0;

 protected:
  Arrived arrived_ = nullptr;  ///< runs the handler; made for each, so that it is one piece of code
  std::uint64_t seen_ = 0;
};

/// Option of an input port: a write runs `Handler`, a member function of the component that takes
/// nothing, the value, or the port's index in its array and the value. What arrives while the
/// component does not run triggers nothing, and can be read later.
template <auto Handler>
struct OnData {};
template <auto Handler>
inline constexpr OnData<Handler> on_data{};

/// Reads what is written to it, wait-free, from this thread or another.
template <typename T>
class InputPort final : public InputPortBase {
  static_assert(PortData<T>, ARMATURE_INTERNAL_PORT_DATA_TEXT);

 public:
  /// Name, documentation and unit are literals. Options: on_data<&X::f>, on_data_update, max_age,
  /// on_lost, may_stay_open, fan_in, size_of(property, factor).
  template <typename... Options>
  InputPort(Component* owner, std::string_view name, std::string_view doc,
            std::string_view unit = {}, Options... options) noexcept
      : InputPort(*owner, name, doc, unit) {
    (apply(options), ...);
  }
  ~InputPort() override;

  /// The newest value (of a FIFO: the next), and whether it is new, was read before, was never
  /// written, or can never come because nothing is connected.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  Reading<T> read() noexcept {
    if (is_special()) [[unlikely]]
      return read_special();
    const Sample<T>& sample = *source_;
    const ReadStatus status = status_of(sample.sequence);
    const bool empty = status < ReadStatus::kOld;
    return {status, false, empty ? about().empty.value : sample.value, sample.time};
  }

  const void* current() const override;
  base::Time current_time() const override;
  std::uint64_t current_sequence() const override;

  // --- for the output port that is connected ---------------------------------------------------
  void connect_source(OutputPortBase& writer, const Sample<T>& source);
  void disconnect(OutputPortBase& writer) override;
  /// Zeros in the shape of `shape`: what is read before the first write.
  void set_shape(const T& shape);
  void drain(internal::ChannelBase& channel) override;
  std::unique_ptr<InputPortBase> twin(StandIn& owner) const override;
  std::unique_ptr<OutputPortBase> make_writer(Component& owner,
                                              std::string_view name) const override;
  /// Runs the handler on a sample that came by `channel`.
  void receive(internal::Channel<T>& channel, const Sample<T>& sample);

 private:
  struct About final : InputPortBase::About {
    using InputPortBase::About::About;
    ~About() override;
    Sample<T> empty{};
  };

  template <typename Port>
  friend class PortArray;
  InputPort(Component& owner, std::string_view name, std::string_view doc,
            std::string_view unit) noexcept;

  About& about() const { return static_cast<About&>(InputPortBase::about()); }

  using InputPortBase::apply;
  template <auto Handler>
  void apply(OnData<Handler>) noexcept {
    triggers_ = true;
    arrived_ = [](InputPortBase& base, ExecutionContext& where) noexcept {
      auto& port = static_cast<InputPort&>(base);
      if (!port.is_simple()) [[unlikely]] {
        port.arrived_with_care(where, [](InputPort& self, const T& value) {
          call<Handler>(self.owner(), self, value);
        });
        return;
      }
      Component& component = port.owner();
      port.inside_ = 1;
      component.enter_handler(where, port, port.outer_,
                              [&] { call<Handler>(component, port, port.source_->value); });
      port.inside_ = 0;
    };
  }

  template <auto Handler>
  static void call(Component& component, InputPort& port, const T& value) {
    using Owner = internal::OwnerOf<Handler>;
    auto& owner = static_cast<Owner&>(component);
    if constexpr (std::is_invocable_v<decltype(Handler), Owner&>) {
      (owner.*Handler)();
    } else {
      port.seen_ = port.source_->sequence;
      if constexpr (std::is_invocable_v<decltype(Handler), Owner&, const T&>) {
        (owner.*Handler)(value);
      } else {
        static_assert(std::is_invocable_v<decltype(Handler), Owner&, std::size_t, const T&>,
                      "a handler of an input port takes (), (value) or (index, value)");
        (owner.*Handler)(port.index(), value);
      }
    }
  }

  [[gnu::noinline]] Reading<T> read_special() noexcept;

  using Handle = void (*)(InputPort&, const T&);
  [[gnu::noinline]] void arrived_with_care(ExecutionContext& where, Handle handle) noexcept;

  /// Takes the next sample of the channels, in turn; the channel it came from, or nullptr.
  internal::Channel<T>* pull();
  /// Of writers that take turns only the newest sample counts.
  internal::Channel<T>* pull_newest();
  void take(internal::Channel<T>& channel, const Sample<T>& sample);
  /// A FIFO's next sample is not passed over: it is the one to be read next.
  void look_for_newer() override;

  const Sample<T>* source_;
};

// Compiled once, in the library.
extern template class InputPort<bool>;
extern template class InputPort<int>;
extern template class InputPort<double>;
extern template class InputPort<std::vector<double>>;

}  // namespace armature::component

#include "armature/component/internal/input_port_definitions.hpp"
