// SPDX-License-Identifier: Apache-2.0
#include "armature/general/reporter/reporter.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <tuple>
#include <utility>

#include "armature/component/host.hpp"
#include "armature/record/console_writer.hpp"
#include "armature/record/csv_writer.hpp"
#include "armature/record/mcap_writer.hpp"
#include "armature/rt/guard.hpp"

namespace armature::general {
namespace {

using component::Component;
using component::Outcome;

constexpr base::Duration kFlushPeriod = std::chrono::seconds(1);
constexpr std::size_t kMostSinks = 3;  ///< MCAP, CSV, console

/// A log line takes so much of a text at a time.
std::string_view part(std::string_view text, std::size_t number) {
  constexpr std::size_t kLength = 95;
  return text.substr(std::min(number * kLength, text.size()), kLength);
}

template <typename Made>
base::Result<std::unique_ptr<record::Writer>> as_writer(base::Result<std::unique_ptr<Made>> made) {
  if (!made) return base::Error{made.error()};
  return std::unique_ptr<record::Writer>(std::move(made).value());
}

}  // namespace

std::vector<Reporter::Objection> Reporter::check_view(
    const std::vector<Component*>& components) const {
  std::vector<Objection> objections = select(what_, components).objections;
  if (what_.get().empty()) {
    objections.push_back({"the property 'what' names nothing", "for example what: [PID1]"});
  }
  object_to_files(components, objections);
  object_to_robot(components, objections);
  return objections;
}

void Reporter::object_to_robot(const std::vector<Component*>& components,
                               std::vector<Objection>& objections) const {
  if (const auto can = record::McapWriter::can_compress(mcap_options().compression); !can) {
    objections.push_back({can.error(), "leave out 'compression'"});
  }
  const Selection joints = select(joints_, components);
  objections.insert(objections.end(), joints.objections.begin(), joints.objections.end());
  if (!joints_.get().empty() && file_.get().empty()) {
    objections.push_back(
        {"the property 'joints' is for an MCAP file, and there is none", "set file"});
  }
  for (const Source& one : joints.sources) {
    if (one.output != nullptr) continue;
    objections.push_back({"'" + one.name + "' of the property 'joints' is no output port",
                          "name ports with measured positions"});
  }
}

std::vector<std::string> Reporter::files() const {
  std::vector<std::string> files;
  for (const auto* file : {&file_.get(), &csv_.get()}) {
    if (!file->empty()) files.push_back(*file);
  }
  return files;
}

void Reporter::object_to_files(const std::vector<Component*>& components,
                               std::vector<Objection>& objections) const {
  const std::vector<std::string> mine = files();
  if (mine.empty() && !console_) {
    objections.push_back({"its recording goes nowhere", "set file, csv or console"});
  }
  if (mine.size() == 2 && mine[0] == mine[1]) {
    objections.push_back({"file and csv are both '" + mine[0] + "'", "give each its own"});
  }
  for (const Component* each : components) {
    if (each == this) return;  // whoever comes later objects
    const auto* const other = dynamic_cast<const Reporter*>(each);
    if (other == nullptr) continue;
    for (const std::string& file : other->files()) {
      if (std::ranges::find(mine, file) == mine.end()) continue;
      objections.push_back({"'" + each->name() + "' writes '" + file + "' too", "rename one"});
    }
  }
}

void Reporter::observe(const component::Surroundings& surroundings) {
  folder_ = surroundings.folder;
  channels_.clear();
  tracks_.clear();
  for (const Source& source : select(what_, surroundings.components).sources) follow(source);
  follow_robot(surroundings);
}

/// Its joints are recorded, too.
void Reporter::follow_robot(const component::Surroundings& surroundings) {
  robot_.reset();
  robot_ports_.clear();
  robot_trouble_.clear();
  std::vector<types::Value> positions;
  for (const Source& source : select(joints_, surroundings.components).sources) {
    const auto same = [&](const record::Channel& one) { return one.name == source.name; };
    if (std::ranges::none_of(channels_, same)) follow(source);
    const auto channel = std::ranges::find_if(channels_, same);
    robot_ports_[static_cast<record::ChannelId>(channel - channels_.begin())] = positions.size();
    positions.push_back(channel->shape);
  }
  if (positions.empty()) return;
  auto robot =
      RobotTrack::make(surroundings.components, std::move(positions), mcap_options().profile);
  if (robot) {
    robot_.emplace(std::move(robot).value());
  } else {
    robot_trouble_ = robot.error();
  }
}

record::McapWriter::Options Reporter::mcap_options() const {
  record::McapWriter::Options options;
  if (profile_ == RecordingProfile::kRos2) options.profile = record::McapWriter::Profile::kRos2;
  if (compression_ != RecordingCompression::kNone) {
    options.compression = types::name_of(compression_.get());
  }
  return options;
}

void Reporter::follow(const Source& source) {
  if (source.property != nullptr) {
    component::PropertyBase& property = *source.property;
    channels_.push_back({source.name, types::Value(property.type(), property.data()),
                         std::string(property.unit()), std::string(property.doc())});
    tracks_.push_back({&property.tap(static_cast<std::size_t>(buffer_.get())), true});
  } else if (source.output != nullptr) {
    follow_port(*source.output, source.name, *source.output);
  } else {
    const auto& writers = source.input->writers();
    for (component::OutputPortBase* writer : writers) {
      const std::string way =
          writers.size() == 1 ? "" : " (" + writer->owner().name() + "." + writer->name() + ")";
      follow_port(*source.input, source.name + way, *writer);
    }
    if (writers.empty())
      log_warning("{} has no writer, so none of its samples is recorded", source.name);
  }
}

/// @param named  the port itself, or an input that it is connected to
void Reporter::follow_port(const component::PortBase& named, std::string name,
                           component::OutputPortBase& output) {
  channels_.push_back({std::move(name), types::Value(output.type(), output.current()),
                       std::string(named.unit()), std::string(named.doc())});
  tracks_.push_back({&output.tap(static_cast<std::size_t>(buffer_.get()),
                                 static_cast<std::uint64_t>(every_.get())),
                     false});
  const bool in_one_thread =
      &component::Host::context(output.owner()) == &component::Host::context(*this) &&
      !is_simulated();
  if (in_one_thread) {
    log_warning("{} waits for the disk as well: give this component a thread of its own",
                output.owner().name());
  }
}

Outcome Reporter::on_start() {
  if (sinks_.empty()) {
    recorded_.assign(0);
    dropped_.assign(0);
    not_written_.assign(0);
    pending_.clear();
    const base::Result<void> opened = open_sinks();
    if (!opened) {
      table_ = nullptr;
      sinks_.clear();
      return component::refused(opened.error());
    }
  }
  begin_ = last_update_ = last_flush_ = time();
  // What was written while it was stopped was not asked for.
  take_all();
  for (Track& track : tracks_) track.dropped = track.tap->dropped();
  collecting_ = true;
  return component::accepted();
}

base::Result<void> Reporter::open_sinks() {
  robot_sink_ = nullptr;
  if (!robot_trouble_.empty()) return base::Error{robot_trouble_};
  sinks_.reserve(kMostSinks);  // one of them is pointed to
  if (!file_.get().empty()) {
    std::vector<record::Channel> channels = channels_;
    if (robot_) std::ranges::move(robot_->channels(), std::back_inserter(channels));
    auto added = add_sink(
        placed(file_),
        [this](const std::string& path) -> base::Result<std::unique_ptr<record::Writer>> {
          auto made = record::McapWriter::create(path, mcap_options());
          if (made && metadata_) {
            const auto told = made.value()->add_metadata("armature", about());
            if (!told) return base::Error{told.error()};
          }
          return as_writer(std::move(made));
        },
        channels);
    if (!added) return added;
    if (robot_) robot_sink_ = &sinks_.back();
  }
  if (!csv_.get().empty()) {
    auto added = add_sink(
        placed(csv_),
        [this](const std::string& path) {
          auto made = record::CsvWriter::create(path);
          if (made) table_ = made.value().get();
          return as_writer(std::move(made));
        },
        channels_);
    if (!added) return added;
  }
  if (!console_) return {};
  return add_sink(
      "console",
      [](const std::string&) {
        return base::Result<std::unique_ptr<record::Writer>>(
            std::make_unique<record::ConsoleWriter>(std::cout));
      },
      channels_);
}

base::Result<void> Reporter::add_sink(const std::string& path, const Sink::Open& open,
                                      const std::vector<record::Channel>& channels) {
  auto sink = Sink::open(path, open, channels);
  if (!sink) return base::Error{sink.error()};
  sinks_.push_back(std::move(sink).value());
  return {};
}

std::string Reporter::placed(const std::string& file) const {
  return (std::filesystem::path(folder_) / file).string();  // an absolute one stays itself
}

void Reporter::on_update() {
  const rt::PermitScope waits_for_the_disk;  // in a thread of its own nobody waits for it
  collect();
  // Cycles that began before the last update have written all they will.
  write_before(std::exchange(last_update_, time()));
  if (time() - last_flush_ < kFlushPeriod) return;
  last_flush_ = time();
  for (Sink& sink : sinks_) sink.flush();
  tell_losses();
}

void Reporter::on_stop() {
  const rt::PermitScope allocates;
  collect();
  collecting_ = false;
}

void Reporter::on_cleanup() {
  if (std::exchange(collecting_, false)) collect();
  write_before(base::Time::max());
  for (Sink& sink : sinks_) sink.close();
  tell_losses();
  tell_end();
  table_ = nullptr;
  robot_sink_ = nullptr;
  sinks_.clear();
  pending_.clear();
  tracks_.clear();  // the taps end with this run
  channels_.clear();
}

void Reporter::collect() {
  take_all();
  count_losses();
}

void Reporter::take_all() {
  for (std::size_t i = 0; i < tracks_.size(); ++i) take_from(static_cast<record::ChannelId>(i));
}

void Reporter::take_from(record::ChannelId channel) {
  Track& track = tracks_[channel];
  component::TappedSample sample;
  // A writer that is faster than this loop does not hold it up.
  for (int left = buffer_; left > 0 && track.tap->take(sample); --left) {
    if (!track.is_property && sample.time < begin_) continue;
    sample.time = std::max(sample.time, begin_);
    if (on_change_ && sample.value == track.last) continue;
    if (on_change_) track.last = sample.value;
    pending_.push_back({channel, std::move(sample)});
  }
}

void Reporter::write_before(base::Time end) {
  std::ranges::sort(pending_, {}, [](const Taken& taken) {
    return std::tuple(taken.sample.time, taken.channel, taken.sample.sequence);
  });
  const auto stop =
      std::ranges::lower_bound(pending_, end, {}, [](const Taken& t) { return t.sample.time; });
  for (auto each = pending_.begin(); each != stop; ++each) {
    const component::TappedSample& sample = each->sample;
    for (Sink& sink : sinks_) {
      sink.write(
          {each->channel, sample.time, static_cast<std::uint32_t>(sample.sequence), sample.value});
    }
    const auto port = robot_ports_.find(each->channel);
    if (robot_ && port != robot_ports_.end()) robot_->take(port->second, sample.value);
    const auto next = std::next(each);
    if (next == stop || next->sample.time != sample.time) write_robot(sample.time);
  }
  recorded_.assign(recorded_ + static_cast<std::uint64_t>(stop - pending_.begin()));
  pending_.erase(pending_.begin(), stop);
  count_losses();
}

/// Once all that was written at a time is known.
void Reporter::write_robot(base::Time time) {
  if (!robot_ || robot_sink_ == nullptr) return;
  for (const RobotTrack::Sample& one : robot_->due(time)) {
    robot_sink_->write(
        {static_cast<record::ChannelId>(channels_.size() + one.channel), time, 0, one.value});
  }
}

void Reporter::count_losses() {
  std::uint64_t dropped = dropped_;
  for (Track& track : tracks_) {
    const std::uint64_t present = track.tap->dropped();
    const std::uint64_t more = present - std::exchange(track.dropped, present);
    track.not_told += more;
    dropped += more;
  }
  if (dropped != dropped_) dropped_.assign(dropped);
  std::uint64_t not_written = 0;
  for (const Sink& sink : sinks_) not_written += sink.not_written();
  if (not_written != not_written_) not_written_.assign(not_written);
}

void Reporter::tell_losses() {
  constexpr int kMostLines = 8;  // the log is to hold other things as well
  int lines = 0;
  std::uint64_t rest = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const std::uint64_t lost = std::exchange(tracks_[i].not_told, 0);
    if (lost == 0) continue;
    if (++lines <= kMostLines) {
      log_warning("dropped {} samples of {}: more than {} came between two cycles", lost,
                  channels_[i].name, buffer_.get());
    } else {
      rest += lost;
    }
  }
  if (rest > 0) log_warning("dropped {} samples of {} others", rest, lines - kMostLines);
  for (Sink& sink : sinks_) tell_complaint(sink);
}

void Reporter::tell_complaint(Sink& sink) {
  const std::string why = sink.take_complaint();
  if (why.empty()) return;
  log_error("{}{}{}; samples that are lost by now: {}", part(why, 0), part(why, 1), part(why, 2),
            sink.not_written());
}

void Reporter::tell_end() {
  count_losses();
  for (const Sink& sink : sinks_) {
    const std::uint64_t lost = sink.not_written();
    log_info("{} samples in {}", recorded_ - lost, sink.path());
    if (lost > 0) log_warning("{} samples are not in {}", lost, sink.path());
  }
  if (table_ != nullptr && table_->replaced() > 0) {
    log_warning("{} samples are not in the table: another of their port and time came after them",
                table_->replaced());
  }
}

}  // namespace armature::general
