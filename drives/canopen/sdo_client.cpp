// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/sdo_client.hpp"

#include "drives/canopen/internal/sdo_frames.hpp"

namespace armature::canopen {

using namespace internal;  // NOLINT: the frames of SDO

void SdoClient::begin(Address address, bool upload, base::Time now) {
  address_ = address;
  upload_ = upload;
  status_ = Status::kBusy;
  code_ = AbortCode::kNone;
  in_segments_ = false;
  toggle_ = false;
  given_ = 0;
  announced_.reset();
  heard_ = now;
}

can::Frame SdoClient::begin_upload(Address address, base::Time now) {
  begin(address, true, now);
  bytes_.clear();
  return with_address(id(), command_byte(request::kUpload), address);
}

can::Frame SdoClient::begin_download(Address address, std::span<const std::uint8_t> bytes,
                                     base::Time now) {
  begin(address, false, now);
  bytes_.assign(bytes.begin(),
                bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kMostSdoBytes)));
  return initiate_frame(id(), request::kDownload, address, bytes_);
}

std::optional<can::Frame> SdoClient::take(const can::Frame& frame, base::Time now) {
  const Origin origin = origin_of(frame);
  if (origin.service != Service::kSdoResponse || origin.node != node_) return std::nullopt;
  if (status_ != Status::kBusy || frame.size != kSdoSize) return std::nullopt;
  if (specifier_of(frame) == kAbort) {
    status_ = Status::kAborted;
    code_ = abort_code_of(frame);
    return std::nullopt;
  }
  heard_ = now;
  return answer(frame);
}

std::optional<can::Frame> SdoClient::answer(const can::Frame& frame) {
  if (!in_segments_) return take_first(frame);
  return upload_ ? take_segment(frame) : give_segment(frame);
}

std::optional<can::Frame> SdoClient::check(base::Time now) {
  if (status_ != Status::kBusy || now <= deadline()) return std::nullopt;
  return abort(AbortCode::kTimeout);
}

std::optional<can::Frame> SdoClient::take_first(const can::Frame& frame) {
  const auto expected = upload_ ? response::kUpload : response::kDownload;
  if (specifier_of(frame) != expected) return abort(AbortCode::kUnknownCommand);
  // An answer to a request before, whose time had run out.
  if (address_of(frame) != address_) return std::nullopt;
  if (!upload_) {
    if (!bytes_.empty() && bytes_.size() <= kExpeditedBytes) {
      status_ = Status::kDone;
      return std::nullopt;
    }
    in_segments_ = true;
    return segment_frame(id(), request::kDownloadSegment, toggle_, bytes_);
  }
  if (is_expedited(frame)) {
    const auto bytes = expedited_bytes(frame);
    bytes_.assign(bytes.begin(), bytes.end());
    status_ = Status::kDone;
    return std::nullopt;
  }
  if ((frame.data[0] & kSizeBit) != 0) announced_ = load(frame.bytes().subspan(4, 4));
  if (announced_ > most_bytes_) return abort(AbortCode::kOutOfMemory);
  in_segments_ = true;
  return segment_request();
}

std::optional<can::Frame> SdoClient::take_segment(const can::Frame& frame) {
  if (specifier_of(frame) != response::kUploadSegment) return abort(AbortCode::kUnknownCommand);
  if (toggle_of(frame) != toggle_) return abort(AbortCode::kToggleBit);
  const auto segment = segment_bytes(frame);
  if (bytes_.size() + segment.size() > most_bytes_) return abort(AbortCode::kOutOfMemory);
  bytes_.insert(bytes_.end(), segment.begin(), segment.end());
  toggle_ = !toggle_;
  if (!is_last(frame)) return segment_request();
  if (announced_ && *announced_ != bytes_.size()) return abort(AbortCode::kWrongLength);
  status_ = Status::kDone;
  return std::nullopt;
}

std::optional<can::Frame> SdoClient::give_segment(const can::Frame& frame) {
  if (specifier_of(frame) != response::kDownloadSegment) return abort(AbortCode::kUnknownCommand);
  if (toggle_of(frame) != toggle_) return abort(AbortCode::kToggleBit);
  given_ += std::min(bytes_.size() - given_, kSegmentBytes);
  if (given_ == bytes_.size()) {
    status_ = Status::kDone;
    return std::nullopt;
  }
  toggle_ = !toggle_;
  return segment_frame(id(), request::kDownloadSegment, toggle_, std::span(bytes_).subspan(given_));
}

can::Frame SdoClient::segment_request() const {
  return with_address(
      id(), command_byte(request::kUploadSegment, toggle_ ? internal::kToggleBit : 0u), {});
}

can::Frame SdoClient::abort(AbortCode code) {
  status_ = Status::kAborted;
  code_ = code;
  return abort_frame(id(), address_, code);
}

}  // namespace armature::canopen
