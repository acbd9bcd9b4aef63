// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "armature/base/seconds.hpp"
#include "armature/inspect/view.hpp"
#include "armature/record/mcap_reader.hpp"
#include "armature/types/elements.hpp"
#include "python/native/bindings.hpp"
#include "python/native/values.hpp"

namespace armature::python {
namespace {

namespace py = pybind11;
using types::Type;

/// The type of a channel of numbers or lists of numbers, by its name; nullptr for others.
const Type* type_of_numbers(const std::string& name) {
  static const std::map<std::string, const Type*> kKnown = [] {
    std::map<std::string, const Type*> known;
    const auto add = [&](const Type& scalar, const Type& list) {
      known[scalar.name] = &scalar;
      known[list.name] = &list;
    };
    known["bool"] = &types::type_of<bool>();
    add(types::type_of<std::int8_t>(), types::type_of<std::vector<std::int8_t>>());
    add(types::type_of<std::uint8_t>(), types::type_of<std::vector<std::uint8_t>>());
    add(types::type_of<std::int16_t>(), types::type_of<std::vector<std::int16_t>>());
    add(types::type_of<std::uint16_t>(), types::type_of<std::vector<std::uint16_t>>());
    add(types::type_of<std::int32_t>(), types::type_of<std::vector<std::int32_t>>());
    add(types::type_of<std::uint32_t>(), types::type_of<std::vector<std::uint32_t>>());
    add(types::type_of<std::int64_t>(), types::type_of<std::vector<std::int64_t>>());
    add(types::type_of<std::uint64_t>(), types::type_of<std::vector<std::uint64_t>>());
    add(types::type_of<float>(), types::type_of<std::vector<float>>());
    add(types::type_of<double>(), types::type_of<std::vector<double>>());
    return known;
  }();
  const auto found = kKnown.find(name);
  return found == kKnown.end() ? nullptr : found->second;
}

/// The samples of one channel.
struct Channel {
  std::vector<const record::RecordedSample*> samples;
};

py::array_t<double> times_of(const Channel& channel) {
  py::array_t<double> times(static_cast<py::ssize_t>(channel.samples.size()));
  double* to = times.mutable_data();
  for (const auto* sample : channel.samples) {
    *to++ = base::to_seconds(sample->time.time_since_epoch());
  }
  return times;
}

py::array_t<std::uint32_t> numbers_of(const Channel& channel) {
  py::array_t<std::uint32_t> numbers(static_cast<py::ssize_t>(channel.samples.size()));
  std::uint32_t* to = numbers.mutable_data();
  for (const auto* sample : channel.samples) *to++ = sample->sequence;
  return numbers;
}

/// One after the other, without what separates them; `rows` has how many each sample has.
struct Numbers {
  std::vector<std::byte> bytes;
  std::vector<std::size_t> rows;

  bool are_even() const {
    return std::ranges::all_of(rows, [&](std::size_t row) { return row == rows.front(); });
  }
};

Numbers read_numbers(const record::McapRecording& recording, const Channel& channel,
                     const Type& type) {
  Numbers numbers;
  types::Value value(type);
  const std::size_t element = types::is_list(type) ? type.element->size : type.size;
  for (const auto* sample : channel.samples) {
    const auto read = recording.read(*sample, type, value.data());
    if (!read) throw inspect::Refusal(read.error());
    const bool is_list = types::is_list(type);
    const std::size_t count = is_list ? types::element_count(type, value.data()) : 1;
    const std::byte* const first =
        is_list ? types::elements(type, value.data()) : static_cast<const std::byte*>(value.data());
    numbers.bytes.insert(numbers.bytes.end(), first, first + count * element);
    numbers.rows.push_back(count);
  }
  return numbers;
}

py::array array_of(const Type& scalar, const std::vector<py::ssize_t>& shape,
                   const std::byte* from) {
  py::array made(*dtype_of(scalar), shape);
  if (made.nbytes() > 0) {
    std::memcpy(made.mutable_data(), from, static_cast<std::size_t>(made.nbytes()));
  }
  return made;
}

/// [n] of scalars, [n, k] of lists; a list of arrays where their sizes differ.
py::object values_of(const record::McapRecording& recording, const Channel& channel,
                     const Type& type) {
  const Numbers numbers = [&] {
    const py::gil_scoped_release others_run;
    return read_numbers(recording, channel, type);
  }();
  const auto count = static_cast<py::ssize_t>(channel.samples.size());
  if (!types::is_list(type)) return array_of(type, {count}, numbers.bytes.data());
  if (numbers.are_even()) {
    const auto row = static_cast<py::ssize_t>(numbers.rows.empty() ? 0 : numbers.rows.front());
    return array_of(*type.element, {count, row}, numbers.bytes.data());
  }
  py::list rows;
  const std::byte* from = numbers.bytes.data();
  for (const std::size_t row : numbers.rows) {
    rows.append(array_of(*type.element, {static_cast<py::ssize_t>(row)}, from));
    from += row * type.element->size;
  }
  return rows;
}

py::list texts_of(const Channel& channel) {
  py::list texts;
  for (const auto* sample : channel.samples) texts.append(text_to_python(sample->json));
  return texts;
}

/// A file's channels: each a dict, whose `values` are arrays, or JSON of what is not of numbers.
py::tuple load(const std::string& file) {
  const record::McapRecording recording = [&] {
    const py::gil_scoped_release others_run;
    auto loaded = record::load_mcap(file, record::Unclosed::kReadToLastChunk);
    if (!loaded) throw inspect::Refusal(loaded.error());
    return std::move(loaded).value();
  }();
  std::vector<Channel> by_channel(recording.channels.size());
  for (const auto& sample : recording.samples)
    by_channel[sample.channel].samples.push_back(&sample);
  py::list channels;
  for (std::size_t i = 0; i < by_channel.size(); ++i) {
    const record::RecordedChannel& about = recording.channels[i];
    const Type* const type = type_of_numbers(about.type);
    py::dict channel;
    channel["name"] = text_to_python(about.name);
    channel["type"] = text_to_python(about.type);
    channel["unit"] = text_to_python(about.unit);
    channel["doc"] = text_to_python(about.doc);
    channel["times"] = times_of(by_channel[i]);
    channel["numbers"] = numbers_of(by_channel[i]);
    channel["json"] = type == nullptr;
    channel["values"] = type == nullptr ? py::object(texts_of(by_channel[i]))
                                        : values_of(recording, by_channel[i], *type);
    channels.append(channel);
  }
  return py::make_tuple(channels, recording.closed);
}

}  // namespace

void bind_recording(py::module_& module) { module.def("load_recording", &load, py::arg("file")); }

}  // namespace armature::python
