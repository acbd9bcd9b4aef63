// SPDX-License-Identifier: Apache-2.0
#include "armature/testing/model/memory.hpp"

#include <algorithm>
#include <stdexcept>

namespace armature::testing::model {
namespace {

bool acquires(Order order) {
  return order == Order::acquire || order == Order::consume || order == Order::acq_rel ||
         order == Order::seq_cst;
}

bool releases(Order order) {
  return order == Order::release || order == Order::acq_rel || order == Order::seq_cst;
}

std::uint64_t updated(const Operation& operation, std::uint64_t old) {
  return operation.kind == Kind::kAdd ? old + operation.operand : operation.operand;
}

}  // namespace

bool Operation::commutes_with(const Operation& other) const {
  if (kind == Kind::kReturn || other.kind == Kind::kReturn) return true;
  if (location != other.location) return true;
  return kind == Kind::kLoad && other.kind == Kind::kLoad;
}

void Memory::reset() {
  locations_.clear();
  views_.fill(View{});
}

std::size_t Memory::add_location(std::size_t thread, std::uint64_t initial) {
  const std::size_t location = locations_.size();
  if (location == kMaxLocations) throw std::length_error("more atomics than kMaxLocations");
  locations_.emplace_back();
  insert(thread, {.kind = Kind::kStore, .location = location}, 0, initial, nullptr);
  return location;
}

std::uint64_t Memory::perform(std::size_t thread, const Operation& operation) {
  switch (operation.kind) {
    case Kind::kLoad:
      return load(thread, operation);
    case Kind::kStore:
      store(thread, operation);
      return 0;
    default:
      return modify(thread, operation);
  }
}

std::uint64_t Memory::read_newest(std::size_t thread, std::size_t location) {
  return read(thread, location, locations_[location].order.size() - 1, Order::relaxed);
}

void Memory::join(View& into, const View& from) const {
  for (std::size_t i = 0; i < locations_.size(); ++i) {
    const std::vector<Store>& stores = locations_[i].stores;
    if (stores[from.newest[i]].rank > stores[into.newest[i]].rank) into.newest[i] = from.newest[i];
  }
  for (std::size_t i = 0; i < kMaxThreads; ++i) {
    into.past[i] = std::max(into.past[i], from.past[i]);
  }
}

std::size_t Memory::least_rank(std::size_t thread, const Operation& operation) const {
  const Location& location = locations_[operation.location];
  const std::size_t known = location.stores[views_[thread].newest[operation.location]].rank;
  if (operation.order != Order::seq_cst) return known;
  return std::max(known, location.stores[location.newest_seq_cst].rank);
}

std::uint64_t Memory::load(std::size_t thread, const Operation& operation) {
  const std::size_t newest = locations_[operation.location].order.size() - 1;
  const std::size_t back = choose_(newest - least_rank(thread, operation) + 1);
  return read(thread, operation.location, newest - back, operation.order);
}

void Memory::store(std::size_t thread, const Operation& operation) {
  const Location& location = locations_[operation.location];
  const std::size_t least = least_rank(thread, operation);
  std::vector<std::size_t> places{location.order.size()};
  for (std::size_t rank = location.order.size() - 1; rank > least; --rank) {
    if (!location.stores[location.order[rank]].follows_directly) places.push_back(rank);
  }
  insert(thread, operation, places[choose_(places.size())], operation.operand, nullptr);
}

std::uint64_t Memory::modify(std::size_t thread, const Operation& operation) {
  const Location& location = locations_[operation.location];
  const std::size_t last = location.order.size() - 1;
  const auto value_at = [&](std::size_t rank) {
    return location.stores[location.order[rank]].value;
  };
  const auto fails_at = [&](std::size_t rank) {
    return operation.kind == Kind::kCompareExchange && value_at(rank) != operation.expected;
  };
  const std::size_t least = least_rank(thread, operation);
  std::vector<std::size_t> readable;
  for (std::size_t rank = last + 1; rank-- > least;) {
    const bool taken = rank < last && location.stores[location.order[rank + 1]].follows_directly;
    if (!taken || fails_at(rank)) readable.push_back(rank);
  }
  const std::size_t rank = readable[choose_(readable.size())];
  if (fails_at(rank)) return read(thread, operation.location, rank, operation.failure_order);
  const std::uint64_t old = read(thread, operation.location, rank, operation.order);
  const View handed_on = location.stores[location.order[rank]].carried;
  insert(thread, operation, rank + 1, updated(operation, old), &handed_on);
  return old;
}

std::uint64_t Memory::read(std::size_t thread, std::size_t location, std::size_t rank,
                           Order order) {
  const std::uint16_t index = locations_[location].order[rank];
  const Store& seen = locations_[location].stores[index];
  views_[thread].newest[location] = index;
  if (acquires(order)) join(views_[thread], seen.carried);
  return seen.value;
}

void Memory::insert(std::size_t thread, const Operation& operation, std::size_t rank,
                    std::uint64_t value, const View* handed_on) {
  Location& location = locations_[operation.location];
  const auto index = static_cast<std::uint16_t>(location.stores.size());
  location.stores.push_back({value, rank, handed_on != nullptr, {}});
  location.order.insert(location.order.begin() + static_cast<std::ptrdiff_t>(rank), index);
  for (std::size_t i = rank; i < location.order.size(); ++i) {
    location.stores[location.order[i]].rank = i;
  }
  if (operation.order == Order::seq_cst && rank > location.stores[location.newest_seq_cst].rank) {
    location.newest_seq_cst = index;
  }
  views_[thread].newest[operation.location] = index;
  View& carried = location.stores[index].carried;
  if (handed_on != nullptr) carried = *handed_on;
  if (releases(operation.order)) join(carried, views_[thread]);
  carried.newest[operation.location] = index;
}

}  // namespace armature::testing::model
