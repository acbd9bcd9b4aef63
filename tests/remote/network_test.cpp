// SPDX-License-Identifier: Apache-2.0
// What a deployment may say of other processes.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/remote/processes.hpp"

namespace armature::remote {
namespace {

using namespace test;
using testing::HasSubstr;

TEST(RemoteDeployment, MistakesAreToldWithTheirPlaces) {
  const Process wrong(R"(network: {inputs: [Axis.Wish, Axis.Wich, Axes.Wish]}
components:
  Axis: {model: Axis, activity: {periodic: 2 ms}}
  A: {model: Axis, remote: tcp://127.0.0.1:4242}
  B: {model: Axis, remote: tcp://127.0.0.1:4242/Axis, activity: {periodic: 2 ms}}
  C: {model: Axis, remote: ftp/Axis}
)");
  const std::string text = wrong.deployment.diagnostics.to_text();
  EXPECT_THAT(text,
              HasSubstr("test.yaml:4:28: error: 'A', remote: 'tcp://127.0.0.1:4242' must be"));
  EXPECT_THAT(text, HasSubstr("'B' lives in another process, which has its activity"));
  EXPECT_THAT(text, HasSubstr("test.yaml:6:28: error: 'C', remote: "));
  EXPECT_THAT(text, HasSubstr("'Axis' has no input 'Wich'"));
  EXPECT_THAT(text, HasSubstr("did you mean 'Wish'?"));
  EXPECT_THAT(text, HasSubstr("unknown component 'Axes'"));
  EXPECT_THAT(text, HasSubstr("max_age: 100 ms"));
}

TEST(RemoteDeployment, AddressesAndPolicyAreCheckedBeforeAnythingListens) {
  const Process wrong(R"(network: {listen: [tcp://127.0.0.1:0, "tcp:nowhere"], policy: no.policy}
components: {Axis: {model: Axis, activity: {periodic: 2 ms}}}
)");
  base::Diagnostics diagnostics = wrong.deployment.diagnostics;
  wrong.network_->check(wrong.deployment.document, diagnostics);
  const std::string text = diagnostics.to_text();
  EXPECT_THAT(text, HasSubstr("test.yaml:1:39: error: "));
  EXPECT_THAT(text, HasSubstr("tcp:nowhere"));
  EXPECT_THAT(text, HasSubstr("no.policy"));
  EXPECT_TRUE(wrong.network_->addresses().empty());
}

TEST(RemoteDeployment, WhoServesOthersHoldsUpNobodyHere) {
  const auto mistakes = [](const std::string& serving) {
    const Process process("network: {listen: tcp://127.0.0.1:0, serving: " + serving +
                          "}\ncomponents: {Axis: {model: Axis, activity: {periodic: 2 ms, "
                          "priority: 30}}}\n");
    base::Diagnostics diagnostics = process.deployment.diagnostics;
    process.network_->check(process.deployment.document, diagnostics);
    return diagnostics.to_text();
  };
  EXPECT_EQ(mistakes("{most: 29, least: 10}"), "");
  EXPECT_THAT(mistakes("{most: 30, least: 10}"),
              HasSubstr("serving with priority 30 would hold up 'Axis', which has 30"));
  EXPECT_THAT(mistakes("{most: 20}"), HasSubstr("serving has no 'least'"));
  EXPECT_THAT(mistakes("{most: 10, least: 20}"), HasSubstr("least of serving is above most"));
  EXPECT_THAT(mistakes("{most: 100, least: 1}"), HasSubstr("most of serving"));
}

TEST(RemoteDeployment, UnknownTransportsAreToldWithTheKnownOnes) {
  const Process wrong(
      R"(network: {listen: ["http://127.0.0.1:80", "tls://127.0.0.1:4243", "ws://127.0.0.1:8080", "wss://0.0.0.0:8443"]}
components:
  Axis: {model: Axis, activity: {periodic: 2 ms}}
  A: {model: Axis, remote: "https://127.0.0.1:443/Axis"}
  B: {model: Axis, remote: "ws://127.0.0.1:8080/Axis"}
  C: {model: Axis, remote: "wss://robot.lab:8443/Axis"}
)");
  base::Diagnostics diagnostics = wrong.deployment.diagnostics;
  wrong.network_->check(wrong.deployment.document, diagnostics);
  const std::string text = diagnostics.to_text();
  EXPECT_THAT(text, HasSubstr("'http://127.0.0.1:80' has the unknown transport 'http' (known: "));
  EXPECT_THAT(text, HasSubstr("tcp, unix, tls, ws, wss"));
  EXPECT_THAT(text, HasSubstr("unknown transport 'https'"));
  EXPECT_THAT(text, HasSubstr("tcp, unix, tls, ws, wss)\n"));
  EXPECT_THAT(text, HasSubstr("'wss://robot.lab:8443/Axis' needs an authority"));
  EXPECT_THAT(text, HasSubstr("'tls://127.0.0.1:4243' needs certificates"));
  EXPECT_THAT(text, HasSubstr("'ws://127.0.0.1:8080' has no pages to serve"));
  EXPECT_THAT(text, HasSubstr("'wss://0.0.0.0:8443' needs a certificate"));
  EXPECT_THAT(text, HasSubstr("'wss://0.0.0.0:8443' has no pages to serve"));
}

TEST(RemoteDeployment, PagesNeedNoAuthorityAndProgramsDo) {
  const Process wrong(
      R"(network: {listen: ["tls://127.0.0.1:4243"], tls: {certificate: a.pem, key: a.key}}
components:
  Axis: {model: Axis, activity: {periodic: 2 ms}}
)");
  base::Diagnostics diagnostics = wrong.deployment.diagnostics;
  ASSERT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  wrong.network_->check(wrong.deployment.document, diagnostics);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("'tls://127.0.0.1:4243' needs certificates"));
}

}  // namespace
}  // namespace armature::remote
