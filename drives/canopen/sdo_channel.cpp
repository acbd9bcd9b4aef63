// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/sdo_channel.hpp"

#include <array>
#include <string>

#include "drives/canopen/little_endian.hpp"

namespace armature::canopen {

base::Result<void> SdoChannel::send(const can::Frame& frame) {
  const can::SendStatus sent = link_.bus().send(frame);
  if (sent == can::SendStatus::kSent) return {};
  return base::Error{"node " + std::to_string(client_.node()) + " is not asked for " +
                     to_text(client_.address()) + ": bus '" + link_.bus().name() + "' says " +
                     can::to_text(sent)};
}

base::Result<void> SdoChannel::exchange(const can::Frame& first, const char* what) {
  if (auto sent = send(first); !sent) return sent;
  while (client_.status() == SdoClient::Status::kBusy) {
    link_.wait_for_news(client_.deadline() + base::Duration(1));
    can::Arrival arrival;
    while (link_.bus().receive(arrival) == can::ReceiveStatus::kReceived) {
      if (listener_) listener_(arrival);
      if (const auto next = client_.take(arrival.frame, link_.now())) {
        if (auto sent = send(*next); !sent) return sent;
      }
    }
    if (const auto abort = client_.check(link_.now())) {
      if (auto sent = send(*abort); !sent) return sent;
    }
  }
  if (client_.status() == SdoClient::Status::kDone) return {};
  return base::Error{"node " + std::to_string(client_.node()) + " does not let " +
                     to_text(client_.address()) + " be " + what + ": " +
                     to_text(client_.abort_code())};
}

base::Result<std::vector<std::uint8_t>> SdoChannel::upload(Address address) {
  const auto done = exchange(client_.begin_upload(address, link_.now()), "read");
  if (!done) return base::Error{done.error()};
  return client_.bytes();
}

base::Result<void> SdoChannel::download(Address address, std::span<const std::uint8_t> bytes) {
  return exchange(client_.begin_download(address, bytes, link_.now()), "written");
}

base::Result<std::int64_t> SdoChannel::read(Address address, DataType type) {
  const auto bytes = upload(address);
  if (!bytes) return base::Error{bytes.error()};
  const unsigned bits = bits_of(type);
  if (bits == 0 || bytes.value().size() != bytes_of_bits(bits)) {
    return base::Error{"node " + std::to_string(client_.node()) + " has " +
                       std::to_string(bytes.value().size()) + " bytes in " + to_text(address) +
                       ", expected " + to_text(type)};
  }
  const std::uint64_t raw = load(bytes.value());
  return is_signed(type) ? sign_extended(raw, bits) : static_cast<std::int64_t>(raw);
}

base::Result<void> SdoChannel::write(Address address, DataType type, std::int64_t value) {
  std::array<std::uint8_t, 8> bytes{};
  store(bytes, static_cast<std::uint64_t>(value));
  const unsigned count = bytes_of_bits(bits_of(type));
  auto written = download(address, std::span(bytes).first(count));
  if (written && record_ != nullptr && count <= SdoClient::kNumberBytes) {
    record_->push_back({address, static_cast<std::uint8_t>(count),
                        static_cast<std::uint32_t>(load(std::span(bytes).first(count))), true});
  }
  return written;
}

}  // namespace armature::canopen
