// SPDX-License-Identifier: Apache-2.0
// usage: rover_figures FOLDER
//
// The figures of the ball-tracking rover, of the recordings that `scripts/demo rover` leaves in
// FOLDER: p and pi, the experiment with both control programs, and realtime; with what memory.json
// there says of processes. Beside them 10 000 images without a ball, which nobody is to see one in.
// Prints JSON, which `armature report` shows if it is figures.json in the folder of the runs.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "armature/base/diagnostic.hpp"
#include "armature/report/run_folder.hpp"
#include "benchmarks/rover_pictures.hpp"
#include "robots/rover/following.hpp"

namespace armature::rover {
namespace {

using Json = nlohmann::ordered_json;
using report::Run;
using report::Signal;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kOnePeriod = 0.045;  // [s] after an image, before the next one

/// The sample at a time, or the last one before it.
std::optional<double> at(const Signal* signal, double time_s) {
  if (signal == nullptr) return std::nullopt;
  const auto after = std::ranges::upper_bound(signal->time_s, time_s + 1e-9);
  if (after == signal->time_s.begin()) return std::nullopt;
  return signal->values[static_cast<std::size_t>(after - signal->time_s.begin()) - 1];
}

/// The first sample from a time on, if it comes before the next image.
std::optional<std::pair<double, double>> after(const Signal* signal, double time_s) {
  if (signal == nullptr) return std::nullopt;
  const auto next = std::ranges::lower_bound(signal->time_s, time_s - 1e-9);
  if (next == signal->time_s.end() || *next > time_s + kOnePeriod) return std::nullopt;
  return std::pair(*next, signal->values[static_cast<std::size_t>(next - signal->time_s.begin())]);
}

View view_at(const Run& run, double time_s) {
  const auto part = [&](const char* name) {
    return at(run.signals.find(std::string("Camera.View.") + name), time_s).value_or(0.0);
  };
  return {part("x"), part("y"), part("heading"), part("ball_x"), part("ball_y"), part("ball_z")};
}

std::vector<Sight> sights_of(const Run& run) {
  std::vector<Sight> sights;
  const Signal* const images = run.signals.find("Camera.View.x");
  if (images == nullptr) return sights;
  for (const double time_s : images->time_s) {
    Sight sight;
    sight.time_s = time_s;
    sight.view = view_at(run, time_s);
    sight.phase = static_cast<int>(at(run.signals.find("Phase.Out"), time_s).value_or(0.0));
    const auto seen = after(run.signals.find("Vision.Seen"), time_s);
    sight.judged = seen.has_value();
    if (seen && seen->second != 0.0) {
      const auto x = after(run.signals.find("Vision.X"), time_s);
      const auto y = after(run.signals.find("Vision.Y"), time_s);
      if (x && y) sight.seen = PicturePoint{x->second, y->second};
    }
    sights.push_back(sight);
  }
  return sights;
}

Json json_of(const std::vector<Sight>& sights) {
  if (sights.empty()) return nullptr;
  const Following worst = following(sights);
  return {{"distance_error_m", worst.distance_error_m},
          {"bearing_deg", worst.bearing_rad * kDegrees},
          {"nearest_m", worst.nearest_m}};
}

Json json_of(const Recognition& all) {
  const auto share = [](std::size_t some, std::size_t of) -> Json {
    return of == 0 ? Json() : Json(static_cast<double>(some) / static_cast<double>(of));
  };
  return {{"whole_in_sight", all.whole},
          {"found", all.found},
          {"found_share", share(all.found, all.whole)},
          {"out_of_sight", all.none},
          {"claimed", all.claimed},
          {"rms_px", all.rms_px},
          {"p99_px", all.p99_px}};
}

/// When the ball is to be seen again: it is whole beyond the screen, or lies on the floor once
/// more.
std::optional<double> back_at(const std::vector<Sight>& sights, int phase) {
  bool away = false;
  for (const Sight& sight : sights) {
    if (sight.phase != phase) continue;
    const bool gone =
        phase == kHidden ? in_sight(sight.view) == InSight::kNothing : is_in_a_hand(sight.view);
    if (away && !gone) return sight.time_s;
    away = away || gone;
  }
  return std::nullopt;
}

Json found_again(const std::vector<Sight>& sights, int phase) {
  const auto back = back_at(sights, phase);
  if (!back) return nullptr;
  const auto found = found_after(sights, *back);
  return found ? Json(*found) : Json();
}

Json experiment(const std::vector<Sight>& sights) {
  Json all;
  all["rest"] = json_of(of_phase(sights, kResting, 1.5));
  const std::vector<Sight> turned = of_phase(sights, kTurned, 0.05);
  if (!turned.empty()) {
    const StepAnswer step = step_answer(turned);
    all["step"] = {{"after_1_s_deg", step.after_1_s_rad * kDegrees}, {"overshoot", step.overshoot}};
  }
  all["line"] = json_of(of_phase(sights, kLine));
  all["circle"] = json_of(of_phase(sights, kCircle, kSettledOnCircle));
  all["eight"] = json_of(of_phase(sights, kEight, kSettledOnEight));
  all["hidden_found_s"] = found_again(sights, kHidden);
  all["carried_found_s"] = found_again(sights, kCarried);
  all["nearest_m"] = sights.empty() ? Json() : json_of(sights)["nearest_m"];
  all["recognition"] = json_of(recognition(sights));
  return all;
}

/// Of a run in real time: how many of the images that were due gave a position, and how late.
Json real_time(const Run& run, Json& figures) {
  const Signal* const images = run.signals.find("Camera.View.x");
  if (images == nullptr || images->time_s.size() < 2) return nullptr;
  std::vector<double> seen_at;
  std::vector<double> late_ms;
  for (const double time_s : images->time_s) {
    if (const auto x = after(run.signals.find("Vision.X"), time_s)) {
      seen_at.push_back(time_s);
      late_ms.push_back(1e3 * (x->first - time_s));
    }
  }
  if (late_ms.empty()) return nullptr;
  add_lateness(seen_at, late_ms, figures);
  std::ranges::sort(late_ms);
  const double due = std::floor(20.0 * (images->time_s.back() - images->time_s.front())) + 1.0;
  return {{"images_due", due},
          {"delivered_share", static_cast<double>(images->time_s.size()) / due},
          {"image_to_position_p99_ms", late_ms[late_ms.size() * 99 / 100]}};
}

/// What scripts/demo has measured of processes; null without it.
Json memory_of(const std::string& folder) {
  std::ifstream file(folder + "/memory.json");
  return file ? Json::parse(file, nullptr, false) : Json();
}

}  // namespace
}  // namespace armature::rover

int main(int argc, char** argv) {
  using namespace armature;
  if (argc != 2) {
    std::cerr << "usage: rover_figures FOLDER\n";
    return 2;
  }
  base::Diagnostics diagnostics;
  const report::Runs runs = report::load_runs(argv[1], diagnostics);
  if (!diagnostics.ok()) {
    std::cerr << diagnostics.to_text() << '\n';
    return 1;
  }
  rover::Json figures;
  for (const report::Run& run : runs.runs) {
    if (run.name.starts_with("realtime")) {
      rover::Json real_time = rover::real_time(run, figures);
      figures["realtime"] = std::move(real_time);
      continue;
    }
    const std::vector<rover::Sight> sights = rover::sights_of(run);
    figures[run.name] = rover::experiment(sights);
    rover::add_curves(run.name, sights, figures);
  }
  figures["memory"] = rover::memory_of(argv[1]);
  rover::add_pictures(figures);
  std::cout << figures.dump(1) << '\n';
  return 0;
}
