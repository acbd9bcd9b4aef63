// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a component on the bench is connected to. Each bears the name of what it stands in for.

#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/rt/guard.hpp"

namespace armature::testing::internal {

/// Something to be done in the component's thread.
template <typename Work>
class Deed final : public rt::Message {
 public:
  explicit Deed(Work& work) : rt::Message(&deliver), work_(work) {}

 private:
  static void deliver(rt::Message& message) { static_cast<Deed&>(message).work_(); }
  Work& work_;
};

template <typename T>
class Writer final : public component::Component {
 public:
  using Component::Component;
  component::OutputPort<T> port{this, name(), "what the test writes"};
};

/// How a command takes an argument: what is not plain data by reference, so that it is not copied.
template <typename T>
using Passed = std::conditional_t<std::is_trivially_copyable_v<T>, T, const T&>;

template <typename... Args>
class Commander final : public component::Component {
 public:
  using Component::Component;
  component::CommandCaller<Passed<Args>...> caller{this, name(), "what the test sends"};
};

template <typename... Args>
class Listener final : public component::Component {
 public:
  using Component::Component;
  std::vector<std::tuple<Args...>> heard;

 private:
  static void hear(void* self, const Args&... arguments) {
    const rt::PermitScope permit;
    static_cast<Listener*>(self)->heard.emplace_back(arguments...);
  }

 public:
  component::EventHandler<Args...> handler{this, name(), &Listener::hear, this, "what is recorded"};
};

template <typename Function>
class Server;
template <typename R, typename... Args>
class Server<R(Args...)> final : public component::Component {
 public:
  using Component::Component;
  std::function<R(Args...)> function;

 private:
  static R serve(void* self, Args... arguments) {
    return static_cast<Server*>(self)->function(static_cast<Args>(arguments)...);
  }

 public:
  component::Operation<R(Args...)> operation{this, name(), &Server::serve, this,
                                             "what the test serves"};
};

/// A value that can be kept: texts of others become std::string.
template <typename T>
auto owned(const T& value) {
  constexpr bool kOfOthers =
      std::is_pointer_v<std::decay_t<T>> || std::is_same_v<T, std::string_view>;
  if constexpr (kOfOthers && std::is_convertible_v<const T&, std::string_view>) {
    return std::string(std::string_view(value));
  } else {
    return value;
  }
}

}  // namespace armature::testing::internal
