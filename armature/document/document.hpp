// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/component/ports/port.hpp"
#include "armature/exec/activity.hpp"
#include "armature/exec/application.hpp"

namespace armature::document {

struct Property;

/// What a user wrote for a property: text, a list or a map. Which type and unit it must have is the
/// model's affair.
struct Value {
  /// Which of its members a value uses.
  enum class Kind { kNone, kText, kList, kMap };

  Kind kind = Kind::kNone;
  std::string text;               ///< of a text
  std::vector<Value> items;       ///< of a list
  std::vector<Property> entries;  ///< of a map, in the order written
  std::string type;      ///< OROCOS type, where an OROCOS file gave one that the text does not show
  bool literal = false;  ///< `{i}` and `${name}` in it are ordinary text
  base::Location where;
};

/// A property and what the user wrote for it.
struct Property {
  std::string name;
  Value value;
  std::string description;  ///< from OROCOS files; empty elsewhere
  base::Location where;     ///< of the name
};

/// A name or path that the user wrote somewhere.
struct Reference {
  std::string name;
  base::Location where;
};

using base::to_text;
using component::Reaction;
using exec::OnFault;
using exec::Overrun;
using types::name_of;

/// How a component runs. A component without an activity is sequential.
struct Activity : exec::Activity {
  bool scheduler_given = false;  ///< else it follows from the priority
  base::Location where;
};

/// A component that this one may use, one way.
struct Peer {
  std::string name;       ///< as the component itself knows it
  std::string component;  ///< full name
  base::Location where;
  bool superior = false;  ///< commands this one, which uses it nevertheless
};

/// Which peer's operation or event serves one that the component requires.
struct Binding {
  std::string name;       ///< what the component requires
  std::string component;  ///< full name of the peer
  std::string member;     ///< the peer's operation or event
  base::Location where;
};

/// A .cpf file read before `properties`, which win over it.
struct PropertyFile {
  std::string path;       ///< relative to the document's folder, or absolute
  bool complete = false;  ///< the file must have every property of the component
  base::Location where;
};

/// One end of a connection, or what is called.
struct Endpoint {
  std::string component;
  std::string port;
  base::Location where;
};

/// An operation or a command of another component that this one calls.
struct Call {
  Endpoint to;
  std::vector<Property> with{};  ///< its parameters: constants, `Component.Port`
  base::Location where;
};

/// A component of the application.
struct Component {
  std::string name;  ///< parts of composites: `instance.part`
  std::string model;
  Reference remote;     ///< `tcp://host:port/Name`: the component lives in another process
  Reference interface;  ///< `FILE.idl` or `FILE.idl#Name`: what it has there, in place of a model
  Activity activity;
  std::vector<Property> properties;
  std::vector<Peer> peers;
  std::vector<Binding> bindings;
  std::vector<Call> calls;        ///< of a component that calls what it is told, in this order
  std::vector<Reference> delays;  ///< components whose results of the previous cycle it uses
  std::vector<PropertyFile> property_files;
  bool autoconf = true;
  bool autostart = true;
  bool autosave = false;  ///< properties are written to the last property file at stop
  bool shadow = false;    ///< looks on, beside those who drive, and moves nothing
  base::Location where;   ///< of the name
  base::Location model_where;
};

/// How data travels along a connection.
struct ConnectionPolicy : component::ConnectionPolicy {
  std::optional<base::Duration> max_age;  ///< of a sample when it is read
  std::optional<Reaction> on_old;         ///< when a sample is older than `max_age`
  std::optional<Reaction> on_lost;        ///< when the writer has stopped or is gone
  bool fan_in = false;                    ///< the input has several writers on purpose
};

/// `Component.Port`.
std::string to_text(const Endpoint& endpoint);

/// A connection from an output port to an input port, or from an event to the command that it
/// gives. Which of them it is, the models say.
struct Connection {
  Endpoint from;
  Endpoint to;
  ConnectionPolicy policy;
  base::Location where;
  std::string name{};  ///< full name of the component that gives the command; empty: any
  std::vector<Property>
      with{};  ///< parameters of the command: constants, `Component.Port`, members
};

/// Ports that share a connection's name: each output among them goes to each input.
struct NamedConnection {
  std::string name;
  std::vector<Endpoint> ports;
  ConnectionPolicy policy;
  base::Location where;
};

/// Which kind of member a composite shows.
enum class ExportKind { kPort, kOperation, kEvent, kProperty };
ARMATURE_ENUM(ExportKind, kPort, kOperation, kEvent, kProperty);

/// What a composite shows of a part as its own.
struct Export {
  ExportKind kind = ExportKind::kPort;
  std::string name;       ///< the composite's
  std::string component;  ///< full name of the part
  std::string member;     ///< the part's
  base::Location where;
};

/// An instance of a composite; its parts are components named `name.part`.
struct Composite {
  std::string name;
  std::string model;
  std::vector<Property> parameters;
  std::vector<Export> exports;
  base::Location where;
};

/// An operation or a command of a component.
struct OperationOf {
  std::string component;  ///< full name
  std::string operation;
  base::Location where;
};

/// Real-time priorities of the thread that serves other processes, by the priority of what it does.
struct Serving {
  int most = 0;
  int least = 0;
  base::Location where;
};

/// How the application is reached from other processes, and reaches them.
struct Network {
  std::vector<Reference> listen;  ///< addresses, such as `tcp://127.0.0.1:4242`
  Reference policy;               ///< file that says who may do what; empty: this machine may read
  Reference pages;                ///< folder that `ws://` addresses serve
  Reference certificate;          ///< files of TLS: certificate and key, or none
  Reference key;
  Reference authority;  ///< of those who need certificates, too; empty: only pages use TLS
  std::vector<Connection> inputs;  ///< that others may write, from `kNetworkName`
  std::optional<int> memory_kb;    ///< that others may make the process keep
  /// Permissions of the socket files, such as 0660; empty: the owner's alone.
  std::optional<unsigned> socket_mode;
  std::optional<Serving> serving;  ///< empty: not in real time
};

/// The component that writes what others send.
inline constexpr const char* kNetworkName = "network";

/// Components that run together; what no mode names runs in all.
struct Mode {
  std::string name;
  std::vector<Reference> components;  ///< full names
  base::Location where;
};

/// What is kept for the case of a fault; what is not given is the runtime's choice.
struct BlackBox {
  bool kept = true;
  std::optional<base::Duration> history;
  std::optional<int> memory_kb;

  bool usual() const { return kept && !history && !memory_kb; }
};

/// What the numbers of priorities mean. RTAI has 1 as the most urgent one, and 255 as the least.
enum class Priorities { kLinux, kRtai };
ARMATURE_ENUM(Priorities, kLinux, kRtai);

/// An application as a user described it: ranges, parameters and composites are expanded, names are
/// resolved as far as the document alone can; nothing is checked against models yet.
struct Document {
  std::string file;
  std::string application;
  OnFault on_fault = OnFault::kStopDependents;
  std::vector<Reference> libraries;
  std::vector<Property> parameters;  ///< their final values
  std::vector<Component> components;
  std::vector<Connection> connections;
  std::vector<NamedConnection> named_connections;
  std::vector<Composite> composites;
  /// Acts of the operator that scripts, or other processes, may do in the operator's stead.
  std::vector<OperationOf> script_grants;
  std::vector<OperationOf> remote_grants;
  bool grants_on_hardware = false;       ///< what scripts are granted counts for real robots, too
  std::vector<OperationOf> before_stop;  ///< commands that are done before an orderly stop
  std::optional<base::Duration> hold_at_stop;
  std::vector<Mode> modes;
  Reference mode;  ///< in which it starts; empty: the first
  BlackBox black_box;
  Priorities priorities = Priorities::kLinux;
  std::vector<Reference> accepted;  ///< names of warnings
  std::vector<Connection>
      operator_inputs;  ///< that the operator may write, from exec::kOperatorName
  /// So many threads it may have, where it says so.
  std::optional<int> most_threads;
  Network network;
};

/// The entry of a map or property list with that name, or nullptr.
const Property* find(const std::vector<Property>& properties, std::string_view name);
Property* find(std::vector<Property>& properties, std::string_view name);

/// Value as YAML on one line: `0.5`, `[1, 2]`, `{x: 1, y: "a b"}`.
std::string to_text(const Value& value);

/// `path` as the program opens it: relative ones count from the document's folder.
std::string path_from(const Document& document, std::string_view path);

}  // namespace armature::document
