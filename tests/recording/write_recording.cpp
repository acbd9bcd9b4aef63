// SPDX-License-Identifier: Apache-2.0
// usage: write_recording MCAP CSV [ros2|none [zstd|lz4]]
// Writes what recording_test.py knows; says the first error of each file and how many calls failed,
// and how many samples were accepted and lost nevertheless.
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "armature/record/csv_writer.hpp"
#include "armature/record/mcap_writer.hpp"
#include "armature/types/struct.hpp"

namespace {

namespace record = armature::record;
namespace types = armature::types;

struct Joint {
  double q = 0.0;
  bool braked = false;
  std::string state;
};
ARMATURE_STRUCT(Joint, (q, "rad", "angle"), braked, state);

constexpr int kTimes = 200;

class Recorder {
 public:
  explicit Recorder(record::Writer& writer) : writer_(writer) {}

  template <typename T>
  void add(const std::string& name, const T& shape, const std::string& unit = {}) {
    note(writer_.add_channel({name, types::Value::of(shape), unit, {}}));
  }

  template <typename T>
  void write(record::ChannelId channel, std::int64_t time_ns, const T& value) {
    std::vector<std::byte> bytes;
    types::encode(types::type_of<T>(), &value, bytes);
    note(writer_.write({channel, armature::base::time_from_ns(time_ns),
                        static_cast<std::uint32_t>(time_ns / 1000), bytes}));
  }

  void close() {
    note(writer_.close());
    if (failed_ == 0) return;
    std::cout << first_error_ << "; " << failed_ << " failed, " << writer_.unsaved() << " lost\n";
  }

 private:
  template <typename T>
  void note(const armature::base::Result<T>& result) {
    if (result) return;
    if (failed_++ == 0) first_error_ = result.error();
  }

  record::Writer& writer_;
  std::string first_error_;
  int failed_ = 0;
};

void write_all(record::Writer& writer) {
  Recorder recorder(writer);
  recorder.add("PID1.Out", 0.0, "V");
  recorder.add("Head.q", std::vector<float>(2), "rad");
  recorder.add("Head.pan", Joint{});
  recorder.add("Odd", std::array<double, 3>{});
  recorder.add("Count", std::uint64_t{0});
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTimes; ++i) {
    const std::int64_t time_ns = std::int64_t{i} * 1'000'000;
    recorder.write(0, time_ns, i * 0.1);
    if (i % 2 == 0) {
      recorder.write(1, time_ns, std::vector<float>{static_cast<float>(i) / 4, -0.5f});
    }
    if (i % 3 == 0) recorder.write(2, time_ns, Joint{i / 3.0, i % 2 == 1, "say \"µ\"\n"});
    if (i % 50 == 0) recorder.write(3, time_ns, std::array{std::nan(""), kInfinity, -kInfinity});
    recorder.write(4, time_ns, ~std::uint64_t{0} - static_cast<std::uint64_t>(i));
  }
  recorder.close();
}

template <typename Writer>
bool write_file(armature::base::Result<std::unique_ptr<Writer>> writer) {
  if (writer) {
    write_all(*writer.value());
  } else {
    std::cout << writer.error() << "\n";
  }
  return writer.ok();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 5) {
    std::cerr << "usage: write_recording MCAP CSV [ros2|none [zstd|lz4]]\n";
    return 2;
  }
  record::McapWriter::Options options;
  options.chunk_size = 4096;
  if (argc > 3 && std::string(argv[3]) == "ros2") {
    options.profile = record::McapWriter::Profile::kRos2;
  }
  if (argc > 4) options.compression = argv[4];
  const bool mcap = write_file(record::McapWriter::create(argv[1], options));
  const bool csv = write_file(record::CsvWriter::create(argv[2]));
  return mcap && csv ? 0 : 1;
}
