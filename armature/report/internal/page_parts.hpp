// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// The files of page/ and of uPlot, put into the library when it is built.
namespace armature::report::internal {

extern const std::string_view kReportHtml;
extern const std::string_view kReportCss;
extern const std::string_view kElementsJs;
extern const std::string_view kFoundJs;
extern const std::string_view kCurvesJs;
extern const std::string_view kReportJs;
extern const std::string_view kUplotCss;
extern const std::string_view kUplotJs;
extern const std::string_view kUplotLicense;

}  // namespace armature::report::internal
