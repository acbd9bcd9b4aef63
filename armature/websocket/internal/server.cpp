// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/server.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <utility>

#include "armature/platform/file.hpp"
#include "armature/ride/socket_connection.hpp"
#include "armature/tls/server_files.hpp"
#include "armature/websocket/internal/request.hpp"

namespace armature::websocket::internal {
namespace {

using platform::StreamListener;
using platform::StreamSocket;

/// A request that is not complete then, and a connection without any, ends.
constexpr unsigned kMostSeconds = 5;
constexpr std::size_t kSecretBytes = 16;
constexpr std::size_t kPieceBytes = 16 * 1024;
/// Of the library: each visitor, its bridge, and what it has itself.
constexpr unsigned kHandlesBeside = 16;

const lws_protocol_vhost_options* headers(const std::string& content_policy,
                                          std::array<lws_protocol_vhost_options, 4>& room) {
  room = {{{&room[1], nullptr, "content-security-policy:", content_policy.c_str()},
           {&room[2], nullptr, "x-content-type-options:", "nosniff"},
           {&room[3], nullptr, "referrer-policy:", "no-referrer"},
           {nullptr, nullptr, "cross-origin-resource-policy:", "same-origin"}}};
  return room.data();
}

bool is_secret(const std::string& text) {
  return text.size() == 2 * kSecretBytes &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool is_encrypted(const Options& options) { return !options.certificate.empty(); }

/// TLS 1.3 alone, and no session is taken up again. The files have been looked at. Pages come
/// without a certificate, programs with one of the authority if there is one.
void encrypt(const Options& options, lws_context_creation_info& info) {
  // Whom the system trusts for the web is nobody here.
  info.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT | LWS_SERVER_OPTION_DISABLE_OS_CA_CERTS;
  if (!options.authority.empty()) {
    info.options |= LWS_SERVER_OPTION_REQUIRE_VALID_OPENSSL_CLIENT_CERT |
                    LWS_SERVER_OPTION_PEER_CERT_NOT_REQUIRED;
    info.ssl_ca_filepath = options.authority.c_str();
  }
  info.alpn = "http/1.1";  // HTTP/2, which browsers prefer, has other headers and other sockets
  info.ssl_cert_filepath = options.certificate.c_str();
  info.ssl_private_key_filepath = options.key.c_str();
  info.ssl_options_set =
      SSL_OP_NO_SSLv3 | SSL_OP_NO_TLSv1 | SSL_OP_NO_TLSv1_1 | SSL_OP_NO_TLSv1_2 | SSL_OP_NO_TICKET;
}

/// As addresses of pages have it.
std::string in_brackets(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

Names names(const Options& options, const std::vector<std::string>& hosts, std::uint16_t port) {
  Names names;
  names.port = port;
  names.encrypted = is_encrypted(options);
  if (!names.encrypted) return names;
  names.hosts.clear();
  for (std::string host : hosts) {
    std::ranges::transform(host, host.begin(),
                           [](unsigned char letter) { return std::tolower(letter); });
    names.hosts.push_back(in_brackets(host));
  }
  return names;
}

}  // namespace

/// Those of an earlier start. A file that is damaged is as good as none.
std::optional<Server::Secrets> Server::secrets_in(const std::string& path) {
  constexpr std::size_t kLine = 2 * kSecretBytes + 1;
  const auto text = platform::read_file(path, 3 * kLine);
  if (!text || text.value().size() != 3 * kLine) return std::nullopt;
  const auto line = [&](std::size_t at) { return text.value().substr(at * kLine, kLine - 1); };
  Secrets found{line(0), line(1), line(2)};
  const bool different = found.token != found.pass && found.token != found.message_key &&
                         found.pass != found.message_key;
  const bool good =
      is_secret(found.token) && is_secret(found.pass) && is_secret(found.message_key) && different;
  return good ? std::optional(std::move(found)) : std::nullopt;
}

base::Result<std::unique_ptr<Server>> Server::listen(const ride::Address& address,
                                                     const Options& options, const Pages& pages,
                                                     const std::vector<std::string>& hosts) {
  auto listener = StreamListener::listen_tcp(address.host, address.port);
  if (!listener) return base::Error{listener.error()};
  ride::Address got = address;
  got.port = listener.value()->port();
  auto server = std::unique_ptr<Server>(
      new Server(std::move(listener).value(), std::move(got), options, pages));
  if (const auto begun = server->begin(hosts); !begun) {
    return base::Error{"'" + address.text() + "': " + begun.error()};
  }
  return server;
}

Server::Server(std::unique_ptr<StreamListener> listener, ride::Address address,
               const Options& options, const Pages& pages)
    : listener_(std::move(listener)),
      address_(std::move(address)),
      options_(options),
      pages_(pages) {}

Server::~Server() {
  ends_ = true;
  if (context_ != nullptr) lws_cancel_service(context_);
  thread_.reset();
  correspondents_.clear();  // from here on nobody rings
  if (context_ != nullptr) lws_context_destroy(context_);
}

base::Result<void> Server::begin(const std::vector<std::string>& hosts) {
  auto bell = StreamSocket::make_pair("a page");
  if (!bell) return base::Error{bell.error()};
  std::tie(bell_, ringer_) = std::move(bell).value();
  if (const auto made = make_context(hosts); !made) return made;
  lws_sock_file_fd_type descriptor{};
  descriptor.filefd = platform::another_handle(listener_->handle());
  listening_ =
      lws_adopt_descriptor_vhost(vhost_, LWS_ADOPT_RAW_FILE_DESC, descriptor, "ride", nullptr);
  if (listening_ == nullptr) return base::Error{"the server of pages has no handle left"};
  if (options_.messages != nullptr) {
    options_.messages->add_address(entry_->socket_url(in_brackets(address_.host)) +
                                   options_.messages->options().path + message_key_);
  }
  platform::ThreadRequest request;
  request.name = "pages";
  thread_ = std::make_unique<platform::Thread>(request, [this] { run(); });
  return {};
}

base::Result<void> Server::make_context(const std::vector<std::string>& hosts) {
  lws_set_log_level(0, nullptr);
  protocols_[0] = {"ride", &Server::told, 0, kPieceBytes,
                   0,      nullptr,       0};  // unless one is asked for
  if (options_.messages != nullptr) {
    const char* const name = options_.messages->options().subprotocol.c_str();
    protocols_[1] = {name, &Server::told, 0, kPieceBytes, 0, nullptr, 0};
  }
  lws_context_creation_info info{};
  info.port = CONTEXT_PORT_NO_LISTEN_SERVER;
  info.protocols = protocols_.data();
  info.user = this;
  info.gid = info.uid = static_cast<decltype(info.uid)>(-1);
  info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS;
  if (is_encrypted(options_)) encrypt(options_, info);
  info.fd_limit_per_thread = static_cast<unsigned>(2 * options_.connections) + kHandlesBeside;
  info.timeout_secs = info.keepalive_timeout = kMostSeconds;
  context_ = lws_create_context(&info);
  if (context_ == nullptr) return base::Error{"the server of pages cannot be made"};
  auto secrets = kept_or_new_secrets();
  if (!secrets) return base::Error{secrets.error()};
  auto& [token, pass, message_key] = secrets.value();
  message_key_ = std::move(message_key);
  entry_.emplace(names(options_, hosts, address_.port), std::move(token), std::move(pass));
  content_policy_ = entry_->content_policy();
  info.headers = headers(content_policy_, header_room_);
  vhost_ = lws_create_vhost(context_, &info);
  if (vhost_ == nullptr) return base::Error{"the server of pages cannot be made"};
  return {};
}

base::Result<Server::Secrets> Server::kept_or_new_secrets() const {
  const bool keeps = !options_.secrets.empty() && !is_encrypted(options_);
  if (keeps) {
    if (auto kept = secrets_in(options_.secrets)) return *std::move(kept);
  }
  Secrets made;
  for (std::string* const one : {&made.token, &made.pass, &made.message_key}) {
    auto text = secret();
    if (!text) return base::Error{text.error()};
    *one = std::move(text).value();
  }
  if (!keeps) return made;
  const auto written = platform::write_file(
      options_.secrets, made.token + "\n" + made.pass + "\n" + made.message_key + "\n");
  if (!written) return base::Error{written.error()};
  return made;
}

base::Result<std::string> Server::secret() const {
  std::array<unsigned char, kSecretBytes> bytes{};
  if (lws_get_random(context_, bytes.data(), bytes.size()) != bytes.size()) {
    return base::Error{"the system gives no random numbers for a token"};
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char each : bytes) {
    text += kDigits[each >> 4];
    text += kDigits[each & 15];
  }
  return text;
}

std::string Server::url() const { return entry_->url(in_brackets(address_.host)); }

void Server::run() {
  while (!ends_ && lws_service(context_, 0) >= 0) {
  }
}

std::unique_ptr<ride::Connection> Server::accept() {
  const std::lock_guard lock(mutex_);
  std::byte rung{};
  std::size_t size = 0;
  static_cast<void>(bell_->receive(std::span(&rung, 1), size));
  if (accepted_.empty()) return nullptr;
  auto connection = std::move(accepted_.front());
  accepted_.pop_front();
  return connection;
}

// --- by the library's thread ---------------------------------------------------------------------

int Server::told(lws* connection, lws_callback_reasons reason, void* /*user*/, void* in,
                 std::size_t size) {
  // The library leaves the verdict to its user: OpenSSL's own is in `size`.
  if (reason == LWS_CALLBACK_OPENSSL_PERFORM_CLIENT_CERT_VERIFICATION) return size == 1 ? 0 : 1;
  if (connection == nullptr || lws_get_context(connection) == nullptr) return 0;
  auto* const server = static_cast<Server*>(lws_context_user(lws_get_context(connection)));
  return server->told(connection, reason, in, size);
}

int Server::told(lws* connection, lws_callback_reasons reason, void* in, std::size_t size) {
  switch (reason) {
    case LWS_CALLBACK_RAW_RX_FILE:
    case LWS_CALLBACK_RAW_WRITEABLE_FILE:
    case LWS_CALLBACK_RAW_CLOSE_FILE:
      return told_of_socket(connection, reason);
    case LWS_CALLBACK_ESTABLISHED:
    case LWS_CALLBACK_RECEIVE:
    case LWS_CALLBACK_SERVER_WRITEABLE:
    case LWS_CALLBACK_CLOSED:
      return told_of_page(connection, reason, in, size);
    case LWS_CALLBACK_HTTP:
      return answer_request(connection, static_cast<const char*>(in), *entry_, pages_);
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION: {
      const bool may =
          speaks_messages(connection) ? may_correspond(connection) : may_open(connection);
      return may ? 0 : answer(connection, HTTP_STATUS_FORBIDDEN);
    }
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
      look_at_correspondents();
      return 0;
    case LWS_CALLBACK_WSI_DESTROY:
      visitors_.erase(connection);
      return 0;
    default:
      return lws_callback_http_dummy(connection, reason, nullptr, in, size);
  }
}

bool Server::speaks_messages(lws* visitor) const {
  const lws_protocols* const spoken = lws_get_protocol(visitor);
  return options_.messages != nullptr && spoken != nullptr && spoken->name == protocols_[1].name;
}

/// The secret is in the address, which no page elsewhere knows, and which no browser sends by
/// itself: so it does not matter from where the page is that asks.
bool Server::may_correspond(lws* visitor) const {
  const std::string path = path_of(visitor);
  const std::string& begin = options_.messages->options().path;
  return entry_->knows_host(visitor_of(visitor)) && path.starts_with(begin) &&
         is_same_secret(std::string_view(path).substr(begin.size()), message_key_);
}

/// Who brings the token or a certificate needs no cookie: browsers let no page send the one, and
/// say by the origin whose page brings the other.
bool Server::may_open(lws* page) const {
  const Visitor visitor = visitor_of(page);
  if (!entry_->is_own_page(visitor)) return false;
  return entry_->has_pass(visitor) || entry_->has_token(visitor) || !proven_name(page).empty();
}

/// By a certificate that the authority has signed; empty: there is none.
std::string Server::proven_name(lws* visitor) const {
  if (options_.authority.empty() || !is_encrypted(options_)) return {};
  return tls::proven_identity(lws_get_ssl(visitor));
}

int Server::told_of_page(lws* page, lws_callback_reasons reason, void* in, std::size_t size) {
  if (reason == LWS_CALLBACK_ESTABLISHED) {
    return (speaks_messages(page) ? open_messages(page) : open(page)) ? 0 : -1;
  }
  if (const auto found = correspondents_.find(page); found != correspondents_.end()) {
    return told_of_correspondent(found, reason, in, size);
  }
  const auto found = bridges_.find(page);
  if (found == bridges_.end()) return -1;
  if (reason == LWS_CALLBACK_CLOSED) {
    bridges_.erase(found);
    return 0;
  }
  Bridge& bridge = *found->second;
  const bool goes_on = reason == LWS_CALLBACK_RECEIVE
                           ? bridge.page_sent({static_cast<const std::byte*>(in), size})
                           : bridge.page_takes();
  return goes_on ? 0 : -1;
}

int Server::told_of_correspondent(Correspondents::iterator who, lws_callback_reasons reason,
                                  void* in, std::size_t size) {
  if (reason == LWS_CALLBACK_CLOSED) {
    correspondents_.erase(who);
    return 0;
  }
  Correspondent& correspondent = *who->second;
  const bool goes_on = reason == LWS_CALLBACK_RECEIVE
                           ? correspondent.sent({static_cast<const std::byte*>(in), size})
                           : correspondent.takes();
  return goes_on ? 0 : -1;
}

void Server::look_at_correspondents() {
  for (const auto& [socket, correspondent] : correspondents_) correspondent->look();
}

int Server::told_of_socket(lws* socket, lws_callback_reasons reason) {
  if (socket == listening_) {
    if (reason == LWS_CALLBACK_RAW_RX_FILE) take_visitors();
    return 0;
  }
  auto* const bridge = static_cast<Bridge*>(lws_get_opaque_user_data(socket));
  if (bridge == nullptr) return 0;
  if (reason == LWS_CALLBACK_RAW_RX_FILE) bridge->node_sent();
  if (reason == LWS_CALLBACK_RAW_WRITEABLE_FILE) bridge->node_takes();
  if (reason == LWS_CALLBACK_RAW_CLOSE_FILE) bridge->no_longer_watched();
  return 0;
}

/// Who comes when all places are taken is sent away.
void Server::take_visitors() {
  while (const auto visitor = listener_->accept()) {
    if (visitors_.size() >= options_.connections) continue;
    const int handle = platform::another_handle(visitor->handle());
    if (handle < 0) continue;
    lws* const taken = lws_adopt_socket_vhost(vhost_, handle);
    if (taken != nullptr) visitors_.insert(taken);
  }
}

bool Server::open(lws* page) {
  std::array<char, 64> address{};
  lws_get_peer_simple(page, address.data(), address.size());
  const std::string name = proven_name(page);
  const std::string kind = name.empty() ? "a page" : "'" + name + "'";
  auto pair = StreamSocket::make_pair(kind + " at " + address.data());
  if (!pair) return false;
  auto& [inner, outer] = pair.value();
  auto bridge = std::make_unique<Bridge>(page, std::move(inner), options_);
  if (!bridge->watch(vhost_)) return false;
  bridges_[page] = std::move(bridge);
  hand_to_node(ride::make_connection(std::move(outer), name.empty() ? "page" : name + "@tls"));
  return true;
}

void Server::hand_to_node(std::unique_ptr<ride::Connection> connection) {
  const std::lock_guard lock(mutex_);
  accepted_.push_back(std::move(connection));
  const std::byte ring{};
  std::size_t sent = 0;
  static_cast<void>(ringer_->send(std::span(&ring, 1), sent));
}

bool Server::open_messages(lws* visitor) {
  Messages& messages = *options_.messages;
  auto pair = StreamSocket::make_pair("a client of " + messages.options().subprotocol);
  if (!pair) return false;
  auto& [inner, outer] = pair.value();
  const auto client = messages.enter([this] { lws_cancel_service(context_); },
                                     ride::make_connection(std::move(inner)));
  if (!client) return false;
  hand_to_node(ride::make_connection(std::move(outer), messages.options().identity));
  correspondents_[visitor] =
      std::make_unique<Correspondent>(visitor, messages, *client, options_.time_to_take);
  return true;
}

}  // namespace armature::websocket::internal
