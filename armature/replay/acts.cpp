// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/acts.hpp"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include <nlohmann/json.hpp>

#include "armature/exec/application_options.hpp"
#include "armature/platform/file.hpp"
#include "armature/platform/output_file.hpp"
#include "armature/record/json.hpp"

namespace armature::replay {
namespace {

using Json = nlohmann::ordered_json;
using exec::Act;
using types::name_of;

/// Of a disk that hangs, no more is kept than this [bytes].
constexpr std::size_t kMostWaiting = 4u << 20;
/// Of a run in real time, which nobody may end for years, this much is enough [bytes].
constexpr std::size_t kMostInRealTime = 256u << 20;

constexpr base::Duration kPatience = std::chrono::seconds(1);

std::string written(const Json& line) {
  return line.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string line_of(const Act& act) {
  if (act.kind == Act::Kind::kRefused) {
    return written({{"refused", act.number}, {"why", act.item}});
  }
  if (act.kind == Act::Kind::kDone) {
    return written({{"done", act.number}, {"time_ns", base::to_ns(act.time)}});
  }
  Json line{{"time_ns", base::to_ns(act.time)},
            {"turn", act.turn},
            {"act", std::string(name_of(act.kind))}};
  if (!act.component.empty()) line["component"] = act.component;
  if (!act.item.empty()) line["item"] = act.item;
  if (!act.values.empty()) {
    line["values"] = Json::array();
    for (const types::Value& value : act.values) {
      line["values"].push_back(record::to_json(value.type(), value.data()));
    }
  }
  if (act.caller != exec::Caller::kOperator) line["caller"] = std::string(name_of(act.caller));
  if (act.command != 0) line["command"] = act.command;
  if (act.attended) line["attended"] = true;
  return written(line);
}

/// A number that is too large, or none, is no number of such a file.
template <typename Number>
Number number_in(const Json& line, const char* name) {
  const Json& value = line.at(name);
  const bool fits =
      std::is_unsigned_v<Number> ? value.is_number_unsigned() : value.is_number_integer();
  if (!fits || value.get<Json::number_unsigned_t>() > std::numeric_limits<Number>::max()) {
    throw Json::other_error::create(501, std::string(name) + " must be a whole number", &value);
  }
  return value.get<Number>();
}

/// Throws what nlohmann throws if a member is missing or is something else.
std::optional<RecordedAct> act_in(const Json& line) {
  RecordedAct read;
  Act& act = read.act;
  const auto kind = types::value_named<Act::Kind>(line.at("act").get<std::string>());
  const auto caller = types::value_named<exec::Caller>(line.value("caller", "operator"));
  const bool is_outcome = kind == Act::Kind::kRefused || kind == Act::Kind::kDone;
  if (!kind || !caller || is_outcome) return std::nullopt;
  act.kind = *kind;
  act.caller = *caller;
  act.time = base::time_from_ns(number_in<std::int64_t>(line, "time_ns"));
  act.turn = number_in<std::uint64_t>(line, "turn");
  act.component = line.value("component", std::string());
  act.item = line.value("item", std::string());
  if (line.contains("command")) act.command = number_in<std::uint32_t>(line, "command");
  act.attended = line.value("attended", false);
  if (line.contains("values")) line["values"].get_to(read.values);
  return read;
}

/// What became of an act.
/// @return whether there is such an act
bool take_outcome(const Json& line, std::vector<RecordedAct>& acts) {
  const bool refused = line.contains("refused");
  const auto number = number_in<std::uint64_t>(line, refused ? "refused" : "done");
  if (number == 0 || number > acts.size()) return false;
  RecordedAct& told = acts[number - 1];
  if (refused) {
    told.refused = line.at("why").get<std::string>();
  } else {
    told.act.time = base::time_from_ns(number_in<std::int64_t>(line, "time_ns"));
  }
  return true;
}

}  // namespace

struct ActsWriter::State {
  explicit State(platform::OutputFile of_acts) : file(std::move(of_acts)) {}

  std::mutex mutex;
  std::condition_variable changed;
  std::string waiting;
  std::size_t taken = 0;  ///< bytes
  std::uint64_t lost = 0;
  bool writing = false;
  bool ending = false;
  bool in_order = true;    ///< each act is in the file before it is done; else in real time
  bool waited_for = true;  ///< until the disk is too slow
  std::optional<base::Error> failure;
  platform::OutputFile file;  ///< the thread's

  void serve() {
    std::string text;
    while (true) {
      {
        std::unique_lock lock(mutex);
        writing = false;
        changed.notify_all();
        changed.wait(lock, [this] { return !waiting.empty() || ending; });
        if (waiting.empty()) return;
        text = std::exchange(waiting, {});
        writing = true;
      }
      const auto written = file.write(text);
      if (written) continue;
      const std::lock_guard lock(mutex);
      if (!failure) failure = base::Error{written.error()};
    }
  }
};

ActsWriter::ActsWriter(std::shared_ptr<State> state) : state_(std::move(state)) {
  platform::ThreadRequest request;
  request.name = "acts";
  request.stack_bytes = 64 * 1024;
  request.prefault = false;
  thread_ = std::make_unique<platform::Thread>(request, [shared = state_] { shared->serve(); });
}

base::Result<std::unique_ptr<ActsWriter>> ActsWriter::create(const std::string& folder,
                                                             ActsWait wait) {
  auto file = platform::OutputFile::create(folder + '/' + kActsFile);
  if (!file) return base::Error{file.error()};
  auto state = std::make_shared<State>(std::move(file).value());
  state->in_order = state->waited_for = wait == ActsWait::kForTheFile;
  return std::unique_ptr<ActsWriter>(new ActsWriter(std::move(state)));
}

ActsWriter::~ActsWriter() { static_cast<void>(close()); }

void ActsWriter::add(const Act& act) {
  const std::string line = line_of(act);
  std::unique_lock lock(state_->mutex);
  const bool enough = !state_->in_order && state_->taken + line.size() > kMostInRealTime;
  const bool too_much = enough || state_->waiting.size() + line.size() > kMostWaiting;
  // Acts are counted: behind one that is lost there is none.
  if (state_->lost > 0 || too_much) {
    if (state_->lost++ == 0) state_->waiting += written({{"lost", true}});
    return;
  }
  state_->taken += line.size();
  state_->waiting += line;
  state_->changed.notify_all();
  if (!state_->waited_for) return;
  state_->waited_for = state_->changed.wait_for(
      lock, kPatience, [this] { return state_->waiting.empty() && !state_->writing; });
}

base::Result<void> ActsWriter::close() {
  if (thread_ == nullptr) return {};
  std::unique_lock lock(state_->mutex);
  state_->changed.wait_for(lock, kPatience,
                           [this] { return state_->waiting.empty() && !state_->writing; });
  const bool complete = state_->waiting.empty() && !state_->writing && state_->lost == 0;
  const std::optional<base::Error> failure = state_->failure;
  state_->ending = true;
  lock.unlock();
  state_->changed.notify_all();
  // It may hang in a disk that takes nothing; the end of the process ends that, too.
  if (!thread_->join_within(std::chrono::milliseconds(100))) thread_->abandon();
  thread_.reset();
  if (failure) return *failure;
  if (complete) return {};
  return base::Error{"not all acts are in '" + state_->file.path() +
                     "', since the disk is too slow, or there were too many: this run cannot be "
                     "replayed"};
}

base::Result<std::vector<RecordedAct>> parse_acts(std::string_view text, const std::string& path) {
  std::vector<RecordedAct> acts;
  std::string_view rest = text;
  for (int number = 1; rest.find('\n') != std::string_view::npos; ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    const std::string place = path + ':' + std::to_string(number) + ": ";
    rest.remove_prefix(line.size() + 1);
    try {
      const Json json = Json::parse(line);
      if (json.contains("lost")) {
        return base::Error{place + "acts are missing from here on: this run cannot be replayed"};
      }
      if (json.contains("refused") || json.contains("done")) {
        if (!take_outcome(json, acts)) return base::Error{place + "there is no such act"};
        continue;
      }
      auto act = act_in(json);
      if (!act) return base::Error{place + "unknown act or caller"};
      acts.push_back(std::move(*act));
    } catch (const Json::exception& problem) {
      return base::Error{place + "not what armature run leaves: " + problem.what()};
    }
  }
  return acts;
}

base::Result<std::vector<RecordedAct>> load_acts(const std::string& folder) {
  const std::string path = folder + '/' + kActsFile;
  const auto content = platform::read_file(path);
  if (!content) return base::Error{content.error()};
  return parse_acts(content.value(), path);
}

}  // namespace armature::replay
