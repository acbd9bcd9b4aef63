// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <libwebsockets.h>

#include "armature/base/result.hpp"
#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/platform/thread.hpp"
#include "armature/ride/transport.hpp"
#include "armature/websocket/internal/bridge.hpp"
#include "armature/websocket/internal/correspondent.hpp"
#include "armature/websocket/internal/entry.hpp"
#include "armature/websocket/internal/pages.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::websocket::internal {

/// Serves the folder at one address, and makes connections of the WebSockets of its pages, or
/// carries messages of another protocol. The library runs in a thread of its own; connections are
/// handed to the node's.
class Server final : public ride::Listener {
 public:
  /// @param hosts  by which it is reached, if the options have a certificate: those that it is for
  static base::Result<std::unique_ptr<Server>> listen(const ride::Address& address,
                                                      const Options& options, const Pages& pages,
                                                      const std::vector<std::string>& hosts = {});
  ~Server() override;

  int handle() const override { return bell_->handle(); }
  std::unique_ptr<ride::Connection> accept() override;
  const ride::Address& address() const override { return address_; }

  const Entry& entry() const { return *entry_; }
  /// Of the first page, with the token.
  std::string url() const;

 private:
  Server(std::unique_ptr<platform::StreamListener> listener, ride::Address address,
         const Options& options, const Pages& pages);
  base::Result<void> begin(const std::vector<std::string>& hosts);
  base::Result<void> make_context(const std::vector<std::string>& hosts);
  /// What lets in: pages, for the first time and then; and those who speak another protocol.
  struct Secrets {
    std::string token;
    std::string pass;
    std::string message_key;
  };
  static std::optional<Secrets> secrets_in(const std::string& path);
  base::Result<Secrets> kept_or_new_secrets() const;
  base::Result<std::string> secret() const;
  void run();

  static int told(lws* connection, lws_callback_reasons reason, void* user, void* in,
                  std::size_t size);
  int told(lws* connection, lws_callback_reasons reason, void* in, std::size_t size);
  int told_of_page(lws* page, lws_callback_reasons reason, void* in, std::size_t size);
  using Correspondents = std::map<lws*, std::unique_ptr<Correspondent>>;
  int told_of_correspondent(Correspondents::iterator who, lws_callback_reasons reason, void* in,
                            std::size_t size);
  int told_of_socket(lws* socket, lws_callback_reasons reason);
  void take_visitors();
  void look_at_correspondents();
  bool speaks_messages(lws* visitor) const;
  bool may_correspond(lws* visitor) const;
  bool may_open(lws* page) const;
  std::string proven_name(lws* visitor) const;
  bool open(lws* page);
  bool open_messages(lws* visitor);
  void hand_to_node(std::unique_ptr<ride::Connection> connection);

  const std::unique_ptr<platform::StreamListener> listener_;
  const ride::Address address_;
  const Options options_;
  const Pages pages_;
  std::optional<Entry> entry_;
  std::string content_policy_;
  std::string message_key_;
  std::array<lws_protocols, 3> protocols_{};
  std::array<lws_protocol_vhost_options, 4> header_room_{};
  /// A byte for each connection that waits for `accept`.
  std::unique_ptr<platform::StreamSocket> bell_;
  std::unique_ptr<platform::StreamSocket> ringer_;
  std::mutex mutex_;
  std::deque<std::unique_ptr<ride::Connection>> accepted_;

  lws_context* context_ = nullptr;
  lws_vhost* vhost_ = nullptr;
  lws* listening_ = nullptr;
  std::set<lws*> visitors_;
  std::map<lws*, std::unique_ptr<Bridge>> bridges_;  ///< by the page's end
  Correspondents correspondents_;
  std::atomic<bool> ends_{false};
  std::unique_ptr<platform::Thread> thread_;
};

}  // namespace armature::websocket::internal
