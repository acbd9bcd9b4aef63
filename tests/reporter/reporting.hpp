// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests of the Reporter: an application that it records.

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/exec/application.hpp"
#include "armature/general/reporter/reporter.hpp"
#include "armature/platform/file.hpp"
#include "armature/record/mcap_reader.hpp"

namespace armature::controllers {

using namespace std::chrono_literals;
using component::Component;
using record::McapRecording;

struct Twist {
  double forward = 0.0;
  int turns = 0;
  bool operator==(const Twist&) const = default;
};
ARMATURE_STRUCT(Twist, (forward, "m/s", "speed"), turns);

/// In its n-th cycle writes n / 2, [n, -n] and {n, 2 n}, and every fourth time another `Slow`;
/// `Twice` twice.
class Writer final : public Component {
 public:
  using Component::Component;
  std::atomic<int> cycles{0};
  bool refuses = false;

 private:
  component::Outcome on_configure() override {
    return refuses ? component::refused("as told") : component::accepted();
  }
  void on_update() override {
    const int n = ++cycles;
    number_.write(0.5 * n);
    pair_[0] = n;
    pair_[1] = -n;
    vector_.write(pair_);
    twist_.write({1.0 * n, 2 * n});
    slow_.write(n / 4);
    twice_.write(n);
    twice_.write(-n);
  }
  component::OutputPort<double> number_{this, "Number", "half of the cycles", "V"};
  component::OutputPort<std::vector<double>> vector_{this, "Vector", "", "rad",
                                                     component::fixed_size(2)};
  component::OutputPort<Twist> twist_{this, "Twist", ""};
  component::OutputPort<int> slow_{this, "Slow", ""};
  component::OutputPort<int> twice_{this, "Twice", ""};
  component::Property<double> gain_{this, "Gain", 2.5, "", "", component::changeable_while_running};
  component::Property<std::string> note_{this, "Note", "as built",
                                         "",   "",     component::changeable_while_running};
  std::vector<double> pair_{0.0, 0.0};
};

class Reader final : public Component {
 public:
  using Component::Component;

 private:
  component::InputPort<double> in_{this, "In", "what it reads", "V"};
  component::InputPort<double> open_{this, "Open", "", "V", component::may_stay_open};
};

/// An application in which `Writer` runs every millisecond and `Reporter` every 50 ms.
class Reporting : public ::testing::Test {
 protected:
  Reporting() {
    options.simulated = true;
    options.log = [this](const rt::LogRecord& record) { log.push_back(record.message()); };
    options.output_folder = ::testing::TempDir() + "/reporter_" +
                            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(options.output_folder);
    std::filesystem::create_directories(options.output_folder);
    writer = &blueprint.add<Writer>("Writer", exec::Activity::periodic(1ms));
    blueprint.add<Reader>("Reader", exec::Activity::periodic(10ms));
    blueprint.connect("Writer.Number", "Reader.In");
    add_reporter("Reporter");
  }
  ~Reporting() override {
    application.reset();
    std::filesystem::remove_all(options.output_folder);
  }

  void add_reporter(const std::string& name) {
    blueprint.add<general::Reporter>(name, exec::Activity::periodic(50ms));
  }
  template <typename T>
  void set(const std::string& property, const T& value, const std::string& reporter = "Reporter") {
    for (const exec::ComponentEntry& entry : blueprint.components) {
      if (entry.component->name() != reporter) continue;
      for (auto* each : component::interface_of(*entry.component).properties) {
        if (each->name() == property) {
          ASSERT_TRUE(each->set(types::Value::of(value)));
        }
      }
    }
  }
  void record(const std::vector<std::string>& what) {
    set("what", what);
    set("file", std::string("run.mcap"));
  }
  exec::Application& make() {
    application = std::make_unique<exec::Application>(std::move(blueprint), options);
    return *application;
  }
  void start() {
    const base::Diagnostics diagnostics = make().start();
    ASSERT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  }
  void run(base::Duration duration) {
    start();
    application->run_for(duration);
    const base::Diagnostics diagnostics = application->stop();
    EXPECT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  }
  std::string path(const std::string& file) const { return options.output_folder + "/" + file; }
  std::string content(const std::string& file) const {
    return platform::read_file(path(file)).value();
  }
  McapRecording load(const std::string& file = "run.mcap") const {
    auto recording = record::load_mcap(path(file));
    EXPECT_TRUE(recording) << recording.error();
    return std::move(recording).value();
  }
  std::uint64_t count(const std::string& attribute) {
    return *application->value_of("Reporter", attribute).value().get_if<std::uint64_t>();
  }

  exec::Blueprint blueprint;
  exec::ApplicationOptions options;
  Writer* writer;
  std::vector<std::string> log;
  std::unique_ptr<exec::Application> application;
};

template <typename T>
T value(const McapRecording& recording, const record::RecordedSample& sample) {
  T read{};
  const auto done = recording.read(sample, types::type_of<T>(), &read);
  EXPECT_TRUE(done) << done.error();
  return read;
}

}  // namespace armature::controllers
