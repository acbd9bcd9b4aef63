// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "armature/base/seconds.hpp"
#include "armature/cli/application_address.hpp"
#include "armature/remote/peer_view.hpp"
#include "armature/ride/node.hpp"
#include "python/native/bindings.hpp"
#include "python/native/simulation.hpp"
#include "python/native/values.hpp"

namespace armature::python {
namespace {

namespace py = pybind11;
using cli::ApplicationAddress;
using inspect::NoAnswer;
using inspect::View;

ride::NodeOptions options_for(const ApplicationAddress& application) {
  base::Diagnostics problems;
  ride::NodeOptions options;
  options.name = "python";
  options.transports = cli::transports_to(application, problems);
  if (!problems.ok()) throw NoAnswer(problems.to_text());
  return options;
}

/// What is the command line's is here an argument of `connect`.
std::string without_dashes(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--")) {
    text.erase(at, 2);
  }
  return text;
}

/// An application at an address.
/// @thread any: one after the other, without the interpreter's lock
class Connection {
 public:
  Connection(const ApplicationAddress& application, double limit_s)
      : node_(options_for(application)), view_(node_.connect(application.address)) {
    const auto there = view_.wait_until_connected(base::from_seconds(limit_s));
    if (!there) throw NoAnswer(there.error());
    if (!view_.has_application()) {
      throw NoAnswer("no application answers at " + application.address + ", only a node");
    }
  }

  template <typename Question>
  auto ask(const Question& question) {
    const py::gil_scoped_release others_run;
    const std::lock_guard one_at_a_time(mutex_);
    return question(view_);
  }
  bool connected() const { return view_.connected(); }

 private:
  std::mutex mutex_;
  ride::Node node_;
  remote::PeerView view_;
};

std::unique_ptr<Connection> connect(const ApplicationAddress& application, double limit_s) {
  if (const std::string problem = cli::wrong_use(application); !problem.empty()) {
    throw py::value_error(without_dashes(problem));
  }
  const py::gil_scoped_release others_run;
  return std::make_unique<Connection>(application, limit_s);
}

py::tuple read(Connection& connection, const std::string& item) {
  const inspect::ItemValue value =
      connection.ask([&](View& view) { return view.read({item}).front(); });
  if (!value.error.empty()) throw inspect::Refusal(value.error);
  const bool is_port = value.kind == "input" || value.kind == "output";
  if (is_port && !value.written) return py::make_tuple(py::none(), value.type, 0.0);
  return py::make_tuple(text_to_python(value.value), value.type, base::to_seconds(value.age));
}

void bind_status_of_commands(py::module_& module) {
  using inspect::CommandStatus;
  py::class_<CommandStatus>(module, "CommandStatus")
      .def_readonly("handle", &CommandStatus::handle)
      .def_readonly("ended", &CommandStatus::ended)
      .def_readonly("progress", &CommandStatus::progress)
      .def_property_readonly("reason", text_of<CommandStatus>(&CommandStatus::reason))
      .def_property_readonly(
          "stage",
          [](const CommandStatus& self) { return std::string(component::name_of(self.stage)); })
      .def_property_readonly("succeeded", [](const CommandStatus& self) {
        return self.stage == component::CommandStage::kDone;
      });
}

/// What looks, and changes nothing.
void bind_questions(py::class_<Connection>& connection) {
  connection.def_property_readonly("connected", &Connection::connected)
      .def("status",
           [](Connection& self) {
             const auto status = self.ask([](View& view) { return view.status(); });
             return py::make_tuple(status.name, base::to_seconds(status.time.time_since_epoch()),
                                   status.simulated);
           })
      .def("component_names",
           [](Connection& self) {
             return self.ask([](View& view) { return view.component_names(); });
           })
      .def(
          "describe",
          [](Connection& self, const std::string& component, bool with_values) {
            const auto values =
                with_values ? inspect::Values::kIncluded : inspect::Values::kLeftOut;
            return self.ask([&](View& view) { return view.describe(component, values); });
          },
          py::arg("component"), py::arg("with_values"))
      .def("components",
           [](Connection& self) { return self.ask([](View& view) { return view.components(); }); })
      .def(
          "log",
          [](Connection& self, std::uint64_t after) {
            return self.ask([&](View& view) { return view.log(after); }).lines;
          },
          py::arg("after"))
      .def("read", &read, py::arg("item"));
}

/// What is done to the application.
void bind_acts(py::class_<Connection>& connection) {
  using Texts = std::vector<std::string>;
  connection
      .def(
          "change",
          [](Connection& self, const std::string& component, const std::string& change) {
            self.ask([&](View& view) { return view.change(component, change_named(change)); });
          },
          py::arg("component"), py::arg("change"))
      .def(
          "write",
          [](Connection& self, const std::string& item, const std::string& value) {
            self.ask([&](View& view) { return view.write(item, value); });
          },
          py::arg("item"), py::arg("value"))
      .def(
          "call",
          [](Connection& self, const std::string& component, const std::string& operation,
             const Texts& arguments) -> py::object {
            const auto result =
                self.ask([&](View& view) { return view.call(component, operation, arguments); });
            if (!result.given) return py::none();
            return py::make_tuple(text_to_python(result.value), result.type);
          },
          py::arg("component"), py::arg("operation"), py::arg("arguments"))
      .def(
          "begin",
          [](Connection& self, const std::string& component, const std::string& command,
             const Texts& arguments) {
            return self.ask([&](View& view) { return view.begin(component, command, arguments); });
          },
          py::arg("component"), py::arg("command"), py::arg("arguments"))
      .def(
          "follow",
          [](Connection& self, std::int32_t handle) {
            return self.ask([&](View& view) { return view.follow(handle); });
          },
          py::arg("handle"))
      .def(
          "cancel",
          [](Connection& self, std::int32_t handle) {
            return self.ask([&](View& view) { return view.cancel(handle); });
          },
          py::arg("handle"));
}

}  // namespace

void bind_connection(py::module_& module) {
  bind_status_of_commands(module);
  py::class_<Connection> connection(module, "Connection");
  connection.def(py::init([](std::string address, std::string certificate, std::string key,
                             std::string authority, std::string tokens, double limit) {
                   return connect({std::move(address), std::move(certificate), std::move(key),
                                   std::move(authority), std::move(tokens)},
                                  limit);
                 }),
                 py::arg("address"), py::arg("certificate"), py::arg("key"), py::arg("authority"),
                 py::arg("tokens"), py::arg("limit"));
  bind_questions(connection);
  bind_acts(connection);
}

}  // namespace armature::python
