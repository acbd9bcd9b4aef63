// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "armature/can/link.hpp"
#include "armature/component/author.hpp"
#include "armature/controllers/base/limited_effort.hpp"
#include "robots/janus/aic/aic_driver.hpp"

namespace armature::janus {

/// What a card said when its host read it.
struct AicSample {
  std::int64_t counts = 0;  ///< of the encoder, since the sample before
  bool fresh = false;       ///< it answered in this cycle
  bool no_bus = false;      ///< the bus is off or down
  bool index = false;       ///< the index switch is closed
  bool actuator_on = false;
  bool restarted = false;    ///< since the sample before: what moved meanwhile is not known
  bool counts_lost = false;  ///< since the sample before: a report did not arrive
};
ARMATURE_STRUCT(AicSample, counts, fresh, no_bus, index, actuator_on, restarted, counts_lost);

/// The host of AIC cards on one bus, which the components AIC use as their peer: to be extended by
/// what the bus is. The first card that is read in a cycle has all of them read.
///
/// Motor values are sent when all cards have theirs; those of a cycle in which one was missing are
/// sent at the beginning of the next. A value that was not set anew for 100 ms is 0: who set it is
/// gone, and the card's watchdog looks at the host only. Whenever the host stops: motor values 0,
/// brakes applied, actuators off.
/// @rt no allocation; waits for the cards' answers, `answer_timeout` for each at most
class AicHost : public component::Component {
 public:
  using Component::Component;

 protected:
  /// Not opened yet.
  virtual base::Result<std::unique_ptr<can::Link>> make_link() = 0;
  const std::vector<int>& cards() const { return numbers_; }
  /// Motor values 0, brakes applied, actuators off.
  void make_safe();

  // Of a bus that has a guardian.
  virtual component::Outcome begin_to_guard() { return component::accepted(); }
  /// A cycle begins; false if the host is out of service.
  virtual bool is_guarded() { return true; }
  /// No cycle is expected.
  virtual void rest() {}
  virtual void end_guard() {}

  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_stop() override { make_safe(); }
  void on_cleanup() override;

 private:
  AicSample read_card(int number);
  bool set_motor(int number, control::LimitedEffort effort);
  bool make_card_safe(int number, int command);
  bool energize_card(int number, int command, control::DrivePermit permit);
  bool command_card(int number, AicCommand command);

  AicDriver::Config config() const;
  void read_all();
  void note_losses();
  AicSample take(std::size_t index);
  bool send_motors();
  std::optional<std::size_t> index_of(int number) const;

  component::Property<std::vector<int>> numbers_{
      this, "cards", {}, "numbers of the cards, 1 to 127", "", component::mandatory};
  component::Property<AicMode> mode_{this, "mode", AicMode::kSynchronous,
                                     "synchronous: one SYNC, a motor frame for four cards; or "
                                     "sequential: a request and a motor frame for each"};
  component::Property<double> supply_{
      this, "supply", 12.0, "voltage of the cards' supply", "V", component::range(0.1, 1000.0)};
  component::Property<double> answer_timeout_{this,  "answer_timeout",
                                              0.001, "how long to wait for a card",
                                              "s",   component::range(0.0002, 1.0)};
  component::Operation<AicSample(int)> read_card_{this,
                                                  "readCard",
                                                  component::serve<&AicHost::read_card>,
                                                  "what a card says in this cycle",
                                                  component::args("number"),
                                                  component::in_own_thread};
  component::Operation<bool(int, control::LimitedEffort)> set_motor_{
      this,
      "setMotor",
      component::serve<&AicHost::set_motor>,
      "the voltage of a card's motor, in this cycle and until the next",
      component::args("number", "effort [V]"),
      component::in_own_thread};
  component::Operation<bool(int, int)> command_card_{
      this,
      "commandCard",
      component::serve<&AicHost::make_card_safe>,
      "sends a command of PROTOCOL.md that makes safe: 2 actuator off, 3 brake apply",
      component::args("number", "command"),
      component::in_own_thread};
  component::Operation<bool(int, int, control::DrivePermit)> energize_card_{
      this,
      "energizeCard",
      component::serve<&AicHost::energize_card>,
      "sends a command of PROTOCOL.md that lets energy in: 1 actuator on, 4 brake release",
      component::args("number", "command", "permit"),
      component::in_own_thread};
  component::Attribute<int> lost_answers_{this, "lost_answers", 0,
                                          "readings since the start without a card's answer"};
  component::Attribute<int> bus_lost_{this, "bus_lost", 0,
                                      "how often since the start the bus was found to be off"};

  /// What a card's component has taken and given.
  struct Account {
    std::int64_t counts = 0;
    std::uint64_t restarts = 0;
    std::uint64_t lost_reports = 0;
    bool taken = false;      ///< in this cycle
    bool motor_set = false;  ///< and not sent yet
    base::Time motor_set_at{};
  };
  std::unique_ptr<can::Link> link_;
  std::optional<AicDriver> driver_;
  std::vector<Account> accounts_;
  std::size_t motors_set_ = 0;
  std::vector<std::optional<std::size_t>> index_of_;  ///< by the card's number
  base::Time read_at_ = base::Time::min();
};

}  // namespace armature::janus
