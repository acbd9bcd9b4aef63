// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/application_address.hpp"

#include <algorithm>
#include <utility>

#include "armature/tls/transport.hpp"

namespace armature::cli {
namespace {

constexpr const char* kTls = "tls://";
constexpr const char* kSchemes[] = {"tcp://", "unix:", kTls};

}  // namespace

bool is_address(const std::string& text) {
  return std::ranges::any_of(kSchemes, [&](const char* one) { return text.starts_with(one); });
}

bool is_encrypted(const ApplicationAddress& application) {
  return application.address.starts_with(kTls);
}

std::string wrong_use(const ApplicationAddress& application) {
  if (!is_address(application.address)) {
    return "'" + application.address +
           "' is not an address: expected one such as tcp://127.0.0.1:4242, unix:/run/robot.sock "
           "or tls://robot:4243";
  }
  const bool all = !application.certificate.empty() && !application.key.empty() &&
                   !application.authority.empty();
  if (is_encrypted(application) && !all) {
    return "a tls:// address needs --certificate, --key and --authority";
  }
  return {};
}

std::vector<std::shared_ptr<ride::Transport>> transports_to(const ApplicationAddress& application,
                                                            base::Diagnostics& diagnostics) {
  std::vector<std::shared_ptr<ride::Transport>> transports;
  if (!is_encrypted(application)) return transports;
  const tls::Options files{application.certificate, application.key, application.authority};
  if (auto made = tls::make_transport(files, diagnostics)) transports.push_back(std::move(made));
  return transports;
}

}  // namespace armature::cli
