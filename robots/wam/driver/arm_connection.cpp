// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/arm_connection.hpp"

#include <charconv>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/seconds.hpp"
#include "armature/control/transmission.hpp"

namespace armature::wam {
namespace {

/// Who walks to the pendant hears how long there is left.
constexpr base::Duration kAskPeriod = std::chrono::seconds(15);

const char* state_text(std::optional<BoardMode> mode) {
  if (!mode) return "has not said its state";
  switch (*mode) {
    case BoardMode::kEstop:
      return "is in E-STOP";
    case BoardMode::kIdle:
      return "is in IDLE";
    case BoardMode::kActive:
      return "is ACTIVATED";
  }
  return "is in an unknown state";
}

/// Talks until what was begun last is done.
class Talk {
 public:
  Talk(can::Link& link, WamStartup& startup, const ArmConnectionConfig& config)
      : link_(link), startup_(startup), config_(config) {}

  base::Result<void> finish() {
    for (;;) {
      const WamProgress progress = startup_.poll(link_.now());
      if (progress == WamProgress::kDone) return {};
      if (progress == WamProgress::kFailed) {
        return base::Error{base::as_reason(startup_.diagnostics())};
      }
      if (progress == WamProgress::kWaitingForIdle && !may_go_on()) return base::Error{refusal()};
      link_.wait_for_news(startup_.deadline());
    }
  }

 private:
  bool may_go_on() {
    const base::Time now = link_.now();
    if (!waits_until_) {
      waits_until_ = now + config_.patience;
      asks_at_ = now;
    }
    if (now >= asks_at_ && now < *waits_until_ && config_.ask_for_idle) {
      config_.ask_for_idle(startup_.board_mode(), *waits_until_ - now);
      asks_at_ = now + kAskPeriod;
    }
    return now < *waits_until_;
  }
  std::string refusal() const {
    return std::string("the safety board ") + state_text(startup_.board_mode()) +
           ", expected IDLE within " +
           std::to_string(std::lround(base::to_seconds(config_.patience))) +
           " s: pull the E-stop button out, press Shift+Idle, and start again";
  }

  can::Link& link_;
  WamStartup& startup_;
  const ArmConnectionConfig& config_;
  std::optional<base::Time> waits_until_;
  base::Time asks_at_{};
};

WamStartup::Config startup_config(const ArmNumbers& numbers) {
  WamStartup::Config config;
  config.motors = numbers.joints();
  const auto transmission = control::Transmission::make(numbers.transmission);
  std::vector<double> motors(numbers.joints());
  transmission.value().motor_angles(numbers.home, motors);
  for (std::size_t i = 0; i < motors.size(); ++i) config.home[i] = motors[i];
  return config;
}

std::string home_text(const ArmNumbers& numbers) {
  std::string text;
  for (const double angle : numbers.home) {
    char digits[32];
    const auto end = std::to_chars(std::begin(digits), std::end(digits), angle).ptr;
    text += (text.empty() ? "" : ", ") + std::string(digits, end);
  }
  return text;
}

}  // namespace

base::Result<WamRecord> connect_arm(can::Link& link, const ArmNumbers& numbers,
                                    const ArmConnectionConfig& config,
                                    std::vector<std::string>& warnings) {
  auto made = WamStartup::make(link.bus(), startup_config(numbers));
  if (!made) return base::Error{made.error()};
  WamStartup& startup = *made.value();
  Talk talk(link, startup, config);
  startup.connect(link.now());
  if (const auto connected = talk.finish(); !connected) return base::Error{connected.error()};
  if (!startup.record().zeroed && !config.at_home) {
    return base::Error{"the pucks have lost their positions (ZERO 0): put the arm at home (" +
                       home_text(numbers) + ") rad, set " + config.word + " = true (--set " +
                       config.word +
                       "=true for a run), and start again; that counts for one start"};
  }
  startup.zero(link.now());
  if (const auto zeroed = talk.finish(); !zeroed) return base::Error{zeroed.error()};
  for (const base::Diagnostic& each : startup.diagnostics().all()) {
    warnings.push_back(base::to_text(each));
  }
  return startup.record();
}

}  // namespace armature::wam
