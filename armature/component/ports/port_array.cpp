// SPDX-License-Identifier: Apache-2.0
#include "armature/component/ports/port_array.hpp"

#include <cstring>

#include "armature/component/host.hpp"

namespace armature::component {

PortArrayBase::PortArrayBase(Component& owner, std::string_view name, Property<int>& count,
                             std::string_view unit) noexcept
    : name_(name), unit_(unit), count_(count) {
  Host::declare(owner).port_arrays.push_back(this);
  count.add_follower(*this);
}

PortArrayBase::~PortArrayBase() = default;

bool PortArrayBase::has_name(std::string_view port) const {
  return port.size() > name_.size() && port.starts_with(name_) &&
         port.find_first_not_of("0123456789", name_.size()) == std::string_view::npos;
}

std::size_t PortArrayBase::wanted() const {
  const int count = count_.get();
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

std::string PortArrayBase::port_name(std::size_t index) const {
  return std::string(name_) + std::to_string(index + 1);
}

void PortArrayBase::keep_options(const void* options, std::size_t size) {
  options_ = std::make_unique<std::byte[]>(size);
  std::memcpy(options_.get(), options, size);
}

void PortArrayBase::forget(InputPortBase& port) {
  std::erase(Host::declare(port.owner()).inputs, &port);
}

void PortArrayBase::forget(OutputPortBase& port) {
  std::erase(Host::declare(port.owner()).outputs, &port);
}

}  // namespace armature::component
