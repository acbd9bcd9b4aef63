// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/log_pump.hpp"

#include <algorithm>
#include <exception>
#include <utility>

namespace armature::exec::internal {

void LogPump::set_engines(std::vector<Engine*> engines) {
  sources_.clear();
  for (Engine* engine : engines) sources_.push_back({engine});
}

void LogPump::drain() {
  for (const Source& source : sources_) drain(*source.engine);
}

void LogPump::drain(Engine& engine) {
  while (const rt::LogRecord* record = engine.log().pop()) {
    tell(*record);
  }
}

void LogPump::tell_losses_now_and_then(base::Time now) {
  if (now >= told_at_ + std::chrono::seconds(1)) tell_losses(now);
}

void LogPump::tell_losses(base::Time now) {
  told_at_ = now;
  for (Source& source : sources_) {
    const std::uint64_t dropped = source.engine->log().dropped();
    const std::uint64_t before = std::exchange(source.told_losses, dropped);
    if (dropped == before) continue;
    rt::LogRecord record;
    record.level = rt::LogLevel::kWarning;
    record.time = now;
    record.component = source.engine->context().name;
    record.format =
        "{} log lines of this thread were dropped: they came faster than they can be printed";
    record.take({dropped - before});
    tell(record);
  }
}

void LogPump::say(std::string_view text, base::Time now) {
  rt::LogRecord record;
  record.level = rt::LogLevel::kWarning;
  record.time = now;
  record.component = "application";
  record.format = "{}";
  record.take({text});
  tell(record);
}

void LogPump::tell(const rt::LogRecord& record) noexcept {
  history_.add(record);
  if (!sink_) return;
  try {
    sink_(record);
  } catch (const std::exception& thrown) {
    failure_ = thrown.what();
    sink_ = nullptr;
  } catch (...) {
    failure_ = "an exception of an unknown type";
    sink_ = nullptr;
  }
}

}  // namespace armature::exec::internal
