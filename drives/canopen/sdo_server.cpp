// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/sdo_server.hpp"

#include <span>

#include "drives/canopen/internal/sdo_frames.hpp"

namespace armature::canopen {

using namespace internal;  // NOLINT: the frames of SDO

std::optional<can::Frame> SdoServer::take(const can::Frame& frame, base::Time now) {
  const Origin origin = origin_of(frame);
  if (origin.service != Service::kSdoRequest || origin.node != node_) return std::nullopt;
  if (frame.size != kSdoSize) return std::nullopt;
  heard_ = now;
  if (specifier_of(frame) == kAbort) {
    reset();
    return std::nullopt;
  }
  return answer(frame);
}

can::Frame SdoServer::answer(const can::Frame& request) {
  switch (specifier_of(request)) {
    case request::kDownload:
      return begin_download(request);
    case request::kUpload:
      return begin_upload(request);
    case request::kDownloadSegment:
      return take_segment(request);
    case request::kUploadSegment:
      return give_segment(request);
    default:
      address_ = address_of(request);
      return abort(AbortCode::kUnknownCommand);
  }
}

std::optional<can::Frame> SdoServer::check(base::Time now) {
  if (phase_ == Phase::kIdle || now <= heard_ + kPatience) return std::nullopt;
  return abort(AbortCode::kTimeout);
}

can::Frame SdoServer::begin_download(const can::Frame& request) {
  address_ = address_of(request);
  phase_ = Phase::kIdle;
  const can::Frame accepted = with_address(id(), command_byte(response::kDownload), address_);
  if (is_expedited(request)) {
    std::span<const std::uint8_t> bytes = expedited_bytes(request);
    // Without a size the object's type knows it.
    const auto* const entry = dictionary_.find(address_);
    if ((request.data[0] & kSizeBit) == 0 && entry != nullptr) {
      const std::size_t size = bytes_of_bits(bits_of(entry->info.type));
      if (size > 0 && size < bytes.size()) bytes = bytes.first(size);
    }
    const AbortCode code = dictionary_.write(address_, bytes);
    return code == AbortCode::kNone ? accepted : abort(code);
  }
  if (const AbortCode code = dictionary_.may_be_written(address_); code != AbortCode::kNone) {
    return abort(code);
  }
  announced_.reset();
  if ((request.data[0] & kSizeBit) != 0) announced_ = load(request.bytes().subspan(4, 4));
  if (announced_ > kMostSdoBytes) return abort(AbortCode::kOutOfMemory);
  bytes_.clear();
  toggle_ = false;
  phase_ = Phase::kDownload;
  return accepted;
}

can::Frame SdoServer::take_segment(const can::Frame& request) {
  if (phase_ != Phase::kDownload) return abort(AbortCode::kUnknownCommand);
  if (toggle_of(request) != toggle_) return abort(AbortCode::kToggleBit);
  const auto segment = segment_bytes(request);
  if (bytes_.size() + segment.size() > kMostSdoBytes) return abort(AbortCode::kOutOfMemory);
  bytes_.insert(bytes_.end(), segment.begin(), segment.end());
  if (is_last(request)) {
    if (announced_ && *announced_ != bytes_.size()) return abort(AbortCode::kWrongLength);
    const AbortCode code = dictionary_.write(address_, bytes_);
    if (code != AbortCode::kNone) return abort(code);
    phase_ = Phase::kIdle;
  }
  can::Frame accepted = with_address(
      id(), command_byte(response::kDownloadSegment, toggle_ ? internal::kToggleBit : 0u), {});
  toggle_ = !toggle_;
  return accepted;
}

can::Frame SdoServer::begin_upload(const can::Frame& request) {
  address_ = address_of(request);
  phase_ = Phase::kIdle;
  bytes_.clear();
  const AbortCode code = dictionary_.read(address_, bytes_);
  if (code != AbortCode::kNone) return abort(code);
  given_ = 0;
  toggle_ = false;
  const can::Frame first = initiate_frame(id(), response::kUpload, address_, bytes_);
  if (!is_expedited(first)) phase_ = Phase::kUpload;
  return first;
}

can::Frame SdoServer::give_segment(const can::Frame& request) {
  if (phase_ != Phase::kUpload) return abort(AbortCode::kUnknownCommand);
  if (toggle_of(request) != toggle_) return abort(AbortCode::kToggleBit);
  const can::Frame segment =
      segment_frame(id(), response::kUploadSegment, toggle_, std::span(bytes_).subspan(given_));
  given_ += segment_bytes(segment).size();
  toggle_ = !toggle_;
  if (is_last(segment)) phase_ = Phase::kIdle;
  return segment;
}

can::Frame SdoServer::abort(AbortCode code) {
  phase_ = Phase::kIdle;
  return abort_frame(id(), address_, code);
}

}  // namespace armature::canopen
