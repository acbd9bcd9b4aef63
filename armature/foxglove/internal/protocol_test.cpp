// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/protocol.hpp"

#include <random>
#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/foxglove/internal/flow_json.hpp"

namespace armature::foxglove::internal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

template <typename T>
T parsed(const std::string& text) {
  const auto request = parse_request(text);
  EXPECT_TRUE(request.ok()) << request.error();
  return request ? std::get<T>(request.value()) : T{};
}

TEST(FoxgloveRequest, HasWhatTheClientAsksFor) {
  const auto subscribe = parsed<Subscribe>(
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":1,"channelId":4}]})");
  EXPECT_THAT(subscribe.subscriptions, ElementsAre(Pair(0, 3), Pair(1, 4)));
  EXPECT_THAT(parsed<Unsubscribe>(R"({"op":"unsubscribe","subscriptionIds":[7]})").subscriptions,
              ElementsAre(7));
  const auto get =
      parsed<GetParameters>(R"({"op":"getParameters","parameterNames":["a.b"],"id":"x"})");
  EXPECT_THAT(get.names, ElementsAre("a.b"));
  EXPECT_EQ(get.id, "x");
  const auto set = parsed<SetParameters>(
      R"({"op":"setParameters","parameters":[{"name":"a","value":[1,2]},{"name":"b"}]})");
  EXPECT_EQ(set.parameters.at(0).value.dump(), "[1,2]");
  EXPECT_TRUE(set.parameters.at(1).value.is_null());
  EXPECT_EQ(set.id, std::nullopt);
  EXPECT_EQ(parsed<FetchAsset>(R"({"op":"fetchAsset","uri":"u","requestId":9})").request, 9u);
}

TEST(FoxgloveRequest, WhatIsNoneIsRefusedAndSaysWhatWasExpected) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"", "in JSON"},
      {"[]", "an object"},
      {"{}", "the text 'op'"},
      {R"({"op":3})", "a text"},
      {R"({"op":"subscribe"})", "the list 'subscriptions'"},
      {R"({"op":"subscribe","subscriptions":[1]})", "the number 'id'"},
      {R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})", "from 0"},
      {R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})", "from 0"},
      {R"({"op":"getParameters","parameterNames":[null]})", "a text"},
      {R"({"op":"setParameters","parameters":[{"value":1}]})", "the text 'name'"},
      {R"({"op":"advertise","channels":[]})", "'advertise' is not offered"},
      {R"({"op":"getParameters","parameterNames":[")" + std::string(2000, 'x') + "\"]}",
       "at most"}};
  for (const auto& [text, why] : wrong) {
    const auto request = parse_request(text);
    ASSERT_FALSE(request.ok()) << text;
    EXPECT_THAT(request.error(), HasSubstr(why)) << text;
  }
}

TEST(FoxgloveRequest, DepthIsBounded) {
  const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
  EXPECT_FALSE(parse_request(deep).ok());
  const auto set = parsed<SetParameters>(
      R"({"op":"setParameters","parameters":[{"name":"a","value":)" + deep + "}]}");
  EXPECT_LT(set.parameters.at(0).value.dump().size(), 200u);
}

TEST(FoxgloveRequest, ObjectsWithVeryManyMembersAreRefused) {
  const auto with_members = [](int count) {
    std::string text = R"({"op":"setParameters","parameters":[{"name":"a","value":{"x":{})";
    for (int i = 0; i < count; ++i) text += ",\"" + std::to_string(i) + "\":0";
    return text + "}}]}";
  };
  EXPECT_TRUE(parse_request(with_members(255)).ok());
  EXPECT_EQ(parse_request(with_members(30'000)).error(),
            "an object of a message has at most 256 members");
}

TEST(FoxgloveRequest, WhateverComesIsTakenOrRefusedWithAReason) {
  const std::vector<std::string> seeds{
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3}]})",
      R"({"op":"setParameters","parameters":[{"name":"a","value":[1,{"b":"c\u00e9"},null]}]})",
      R"({"op":"getParameters","parameterNames":["a"],"id":"x"})"};
  std::mt19937 random(1);
  int taken = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = seeds[random() % seeds.size()];
    for (std::size_t changes = random() % 4; changes > 0; --changes) {
      const std::size_t place = random() % text.size();
      if (random() % 2 == 0) text[place] = static_cast<char>(random());
      if (random() % 3 == 0) text.erase(place, random() % 8);
      if (random() % 3 == 0) text.insert(place, text.substr(0, random() % text.size()));
      if (text.empty()) text = "{";
    }
    const auto request = parse_request(text);
    if (!request) {
      EXPECT_FALSE(request.error().empty()) << text;
    } else if (const auto* set = std::get_if<SetParameters>(&request.value())) {
      for (const Parameter& one : set->parameters) static_cast<void>(text_of_json(one.value).ok());
      ++taken;
    }
  }
  EXPECT_GT(taken, 100);
}

TEST(FoxgloveMessage, ValuesAreBinaryWithNumberAndTime) {
  const std::string message = message_data(0x01020304, base::time_from_ns(256), "{}");
  EXPECT_EQ(message, std::string("\x01\x04\x03\x02\x01\x00\x01\x00\x00\x00\x00\x00\x00{}", 15));
  EXPECT_EQ(time_message(base::time_from_ns(1)),
            std::string("\x02\x01\x00\x00\x00\x00\x00\x00\x00", 9));
  EXPECT_EQ(asset(1, std::string("ab")), std::string("\x04\x01\x00\x00\x00\x00\x00\x00\x00\x00"
                                                     "ab",
                                                     12));
  EXPECT_EQ(asset(1, base::Error{"no"}),
            std::string("\x04\x01\x00\x00\x00\x01\x02\x00\x00\x00no", 12));
}

TEST(FoxgloveMessage, ParametersHaveTheTypesThatClientsAskFor) {
  const std::string text = parameter_values(
      {{"a", 1.5}, {"b", Json::array({1, 2})}, {"c", "x"}, {"d", Json::array({"y"})}}, "id");
  const Json json = Json::parse(text);
  EXPECT_EQ(json["id"], "id");
  EXPECT_EQ(json["parameters"][0]["type"], "float64");
  EXPECT_EQ(json["parameters"][1]["type"], "float64_array");
  EXPECT_FALSE(json["parameters"][2].contains("type"));
  EXPECT_FALSE(json["parameters"][3].contains("type"));
}

}  // namespace
}  // namespace armature::foxglove::internal
