// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/remote_browser.hpp"

#include <chrono>
#include <thread>

#include "armature/browser/internal/console.hpp"
#include "armature/browser/internal/remote_browsing.hpp"
#include "armature/ride/node.hpp"

namespace armature::browser {
namespace {

/// For the first connection; those that are lost are waited for as long as it takes.
constexpr base::Duration kConnectionLimit = std::chrono::seconds(3);

}  // namespace

std::size_t browse_remotely(const RemoteBrowserOptions& options, std::string& problem) {
  ride::NodeOptions node_options;
  node_options.name = "armature browse";
  node_options.transports = options.transports;
  ride::Node node(node_options);
  ride::Peer& peer = node.connect(options.address);
  remote::PeerView view(peer);
  if (const auto there = peer.wait_until_connected(kConnectionLimit); !there) {
    problem = there.error();
    return 0;
  }
  internal::Console console;
  internal::RemoteBrowsing browsing(view, console.surface(),
                                    [](base::Duration time) { std::this_thread::sleep_for(time); });
  return console.run(browsing.browser, browsing.language.vocabulary().quitting);
}

}  // namespace armature::browser
