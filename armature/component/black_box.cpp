// SPDX-License-Identifier: Apache-2.0
#include "armature/component/black_box.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

#include "armature/component/component.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/host.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/rt/ticks.hpp"

namespace armature::component {
namespace {

using types::Kind;
using types::Type;

/// Calls `visit(data, size)` for each stretch of bytes that a value consists of; where they are
/// does not change as long as its vectors keep their sizes.
template <typename Visit>
void visit_bytes(const Type& type, const void* value, const Visit& visit) {
  const auto* const bytes = static_cast<const std::byte*>(value);
  if (type.fixed_size()) {
    visit(bytes, type.size);
  } else if (type.kind == Kind::kStruct) {
    for (const types::Field& field : type.fields) {
      visit_bytes(*field.type, bytes + field.offset, visit);
    }
  } else if (type.element != nullptr) {
    const bool is_array = type.kind == Kind::kArray;
    const std::size_t count = is_array ? type.count : type.vector_size(value);
    const auto* const first =
        is_array ? bytes
                 : static_cast<const std::byte*>(type.vector_data(const_cast<void*>(value)));
    if (type.element->fixed_size()) {
      visit(first, count * type.element->size);
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      visit_bytes(*type.element, first + i * type.element->size, visit);
    }
  }
}

/// What is larger, such as an image, would take the place of what led to a fault.
constexpr std::size_t kLargestValue = 16 * 1024;

std::size_t bytes_in(const OutputPortBase& port) {
  std::size_t all = 0;
  visit_bytes(port.type(), port.current(),
              [&](const std::byte* /*from*/, std::size_t size) { all += size; });
  return all;
}

/// The `count` newest of a ring in which `taken` were put, the oldest first.
template <typename Each>
void visit_ring(std::uint64_t taken, std::size_t count, const Each& each) {
  for (std::uint64_t i = taken - std::min<std::uint64_t>(taken, count); i < taken; ++i) {
    each(static_cast<std::size_t>(i % count));
  }
}

}  // namespace

std::string_view name_of(BlackBox::Note::Kind kind) {
  using enum BlackBox::Note::Kind;
  switch (kind) {
    case kState:
      return "state";
    case kError:
      return "error";
    case kFault:
      return "fault";
    case kReaction:
      return "reaction";
    case kBegun:
      return "command begun";
    case kRefused:
      return "command refused";
    case kDone:
      return "command done";
    case kFailed:
      return "command failed";
    case kCancelled:
      return "command cancelled";
    case kProperty:
      return "property set";
    case kCall:
      return "operation called";
  }
  return "unknown";
}

void BlackBox::add(const Component& component) {
  for (const OutputPortBase* port : interface_of(component).outputs) {
    if (bytes_in(*port) > kLargestValue) continue;
    Channel channel{port, nullptr, ports_size_, {}};
    if (!port->type().fixed_size()) channel.shape.emplace(port->type(), port->current());
    channels_.push_back(std::move(channel));
    visit_bytes(port->type(), port->current(), [&](const std::byte* from, std::size_t size) {
      spans_.push_back({from, size});
      ports_size_ += size;
    });
  }
  for (const EventBase* event : interface_of(component).events) events_.push_back(event);
}

void BlackBox::reserve(std::size_t pictures, std::size_t notes, base::Duration interval) {
  for (std::size_t i = 0; i < events_.size(); ++i) {
    channels_.push_back({nullptr, events_[i], ports_size_ + i * sizeof(std::uint64_t), {}});
  }
  pictures_.assign(pictures * picture_size(), std::byte{});
  times_.assign(pictures, {});
  notes_.assign(notes, {});
  interval_ = interval;
  early_ = interval / 4;
  if (!pictures_.empty()) due_ = base::Time::min();
}

void BlackBox::make_picture(base::Time now) noexcept {
  if (times_.empty()) return;
  const bool again = now == made_;
  made_ = now;
  due_ = now + interval_ - early_;
  if (!lock_.try_lock()) return count_missed();
  if (again && pictures_made_ > 0) --pictures_made_;
  const std::size_t place = static_cast<std::size_t>(pictures_made_++ % times_.size());
  times_[place] = now;
  std::byte* to = pictures_.data() + place * picture_size();
  for (const Span& span : spans_) {
    if (span.size == sizeof(double)) {
      std::memcpy(to, span.from, sizeof(double));
    } else {
      std::memcpy(to, span.from, span.size);
    }
    to += span.size;
  }
  for (const EventBase* event : events_) {
    const std::uint64_t raised = event->raised();
    std::memcpy(to, &raised, sizeof raised);
    to += sizeof raised;
  }
  lock_.unlock();
}

void BlackBox::note(Note::Kind kind, const Component& component, std::string_view item,
                    std::string_view text) noexcept {
  if (notes_.empty()) return;
  const bool decisive = kind == Note::Kind::kFault || kind == Note::Kind::kReaction;
  if (decisive && due_ != base::Time::max()) due_ = base::Time::min();
  if (!lock_.try_lock()) return count_missed();
  Note& place = notes_[static_cast<std::size_t>(notes_taken_++ % notes_.size())];
  place.kind = kind;
  place.time = component.time();
  place.component = &component;
  place.item = item;
  place.text = text;
  lock_.unlock();
}

std::optional<BlackBox::Content> BlackBox::copy() const {
  constexpr base::Duration kPatience = std::chrono::seconds(1);
  Content content;
  content.pictures.reserve(pictures_.size());
  content.times.reserve(times_.size());
  content.notes.reserve(notes_.size());
  const base::Time deadline = rt::monotonic_now() + kPatience;
  while (!lock_.try_lock()) {
    if (rt::monotonic_now() > deadline) return std::nullopt;
  }
  if (!times_.empty()) {
    visit_ring(pictures_made_, times_.size(), [&](std::size_t i) {
      const std::byte* const from = pictures_.data() + i * picture_size();
      content.pictures.insert(content.pictures.end(), from, from + picture_size());
      content.times.push_back(times_[i]);
    });
  }
  if (!notes_.empty()) {
    visit_ring(notes_taken_, notes_.size(),
               [&](std::size_t i) { content.notes.push_back(notes_[i]); });
  }
  lock_.unlock();
  return content;
}

types::Value BlackBox::value_in(const std::byte* picture, const Channel& channel) {
  const std::byte* from = picture + channel.offset;
  if (channel.port == nullptr) {
    std::uint64_t count = 0;
    std::memcpy(&count, from, sizeof count);
    return types::Value::of(count);
  }
  types::Value value = channel.shape ? *channel.shape : types::Value(channel.port->type());
  visit_bytes(value.type(), value.data(), [&](const std::byte* to, std::size_t size) {
    std::memcpy(const_cast<std::byte*>(to), from, size);
    from += size;
  });
  return value;
}

void note(const Component& component, BlackBox::Note::Kind kind, std::string_view item,
          std::string_view text) noexcept {
  if (Host::context(component).black_box != nullptr) {
    Host::context(component).black_box->note(kind, component, item, text);
  }
}

}  // namespace armature::component
