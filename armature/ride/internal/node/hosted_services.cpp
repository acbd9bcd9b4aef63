// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/hosted_services.hpp"

#include <algorithm>
#include <utility>

namespace armature::ride::internal {

Publisher& Hosted::publisher() const { return ServiceAccess::publisher(*service); }

ComponentEntry Hosted::entry() const {
  return {static_cast<std::int32_t>(identifier), name, std::string(interface().name), digest};
}

base::Result<std::uint32_t> HostedServices::add(const std::string& node, std::string name,
                                                Service& service) {
  const auto found = std::ranges::find_if(all_, [&](const Hosted& hosted) {
    return hosted.service == &service || (hosted.service != nullptr && hosted.name == name);
  });
  if (found != all_.end()) {
    return base::Error{"node '" + node + "' already hosts '" + found->name + "': give '" + name +
                       "' another name, or remove the first"};
  }
  const auto next = static_cast<std::uint32_t>(all_.size() + 1);
  const std::lock_guard lock(mutex_);
  all_.push_back({next, std::move(name), digest(service.interface()), &service});
  return next;
}

std::uint32_t HostedServices::remove(Service& service) {
  const auto found = std::ranges::find(all_, &service, &Hosted::service);
  if (found == all_.end()) return 0;
  {
    const std::lock_guard lock(mutex_);
    found->service = nullptr;
  }
  ServiceAccess::publisher(service).remove_all();
  return found->identifier;
}

const Hosted* HostedServices::find(std::uint32_t identifier) const {
  if (identifier == 0 || identifier > all_.size()) return nullptr;
  const Hosted& hosted = all_[identifier - 1];
  return hosted.service != nullptr ? &hosted : nullptr;
}

const Hosted* HostedServices::find(std::string_view name) const {
  const auto found = std::ranges::find_if(
      all_, [&](const Hosted& hosted) { return hosted.service != nullptr && hosted.name == name; });
  return found != all_.end() ? &*found : nullptr;
}

std::vector<ComponentEntry> HostedServices::entries() const {
  std::vector<ComponentEntry> entries;
  for (const Hosted& hosted : all_) {
    if (hosted.service != nullptr) entries.push_back(hosted.entry());
  }
  return entries;
}

void HostedServices::unsubscribe(const Link& link) const {
  for (const Hosted& hosted : all_) {
    if (hosted.service != nullptr) hosted.publisher().remove(link);
  }
}

void HostedServices::unsubscribe_all() const {
  for (const Hosted& hosted : all_) {
    if (hosted.service != nullptr) hosted.publisher().remove_all();
  }
}

}  // namespace armature::ride::internal
