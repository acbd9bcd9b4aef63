// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/policy.hpp"

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pwd.h>
#include <unistd.h>

#include "armature/ride/internal/test_vision.hpp"

namespace armature::ride {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

Policy policy_of(std::string_view text) {
  base::Diagnostics diagnostics;
  Policy policy = Policy::parse(text, "policy.txt", diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
  return policy;
}

std::string mistakes_of(std::string_view text) {
  base::Diagnostics diagnostics;
  EXPECT_TRUE(Policy::parse(text, "policy.txt", diagnostics).rules().empty());
  EXPECT_FALSE(diagnostics.ok());
  return diagnostics.to_text();
}

AccessQuestion by_tls(std::string_view identity, Access access, std::string_view component) {
  return {"tls", identity, component, access};
}

TEST(Policy, WithoutARuleNothingIsAllowed) {
  EXPECT_FALSE(policy_of("").allows({"unix", "", "Vision", Access::kRead}));
  EXPECT_FALSE(policy_of("# allow * read *\n\n").allows({"unix", "", "Vision", Access::kRead}));
}

TEST(Policy, ARuleAllowsWhatItSaysAndNothingElse) {
  const Policy policy = policy_of("allow operator@tls  read,command   Vision,Arm  # the day shift");
  EXPECT_TRUE(policy.allows(by_tls("operator", Access::kRead, "Vision")));
  EXPECT_TRUE(policy.allows(by_tls("operator", Access::kCommand, "Arm")));
  EXPECT_FALSE(policy.allows(by_tls("operator", Access::kConfigure, "Vision")));
  EXPECT_FALSE(policy.allows(by_tls("operator", Access::kRead, "Visio")));
  EXPECT_FALSE(policy.allows(by_tls("operator", Access::kRead, "vision")));
  EXPECT_FALSE(policy.allows(by_tls("Operator", Access::kRead, "Vision")));
  EXPECT_FALSE(policy.allows(by_tls("operator2", Access::kRead, "Vision")));
  EXPECT_FALSE(policy.allows({"unix", "operator", "Vision", Access::kRead}));
}

TEST(Policy, TwoTogetherAllowWhatOneAllows) {
  Policy policy = policy_of("allow operator@tls read Vision");
  policy.add(policy_of("allow operator@tls command Arm"));
  EXPECT_TRUE(policy.allows(by_tls("operator", Access::kRead, "Vision")));
  EXPECT_TRUE(policy.allows(by_tls("operator", Access::kCommand, "Arm")));
  EXPECT_FALSE(policy.allows(by_tls("operator", Access::kCommand, "Vision")));
}

TEST(Policy, LocalIsWhoProvesNothingOnThisMachine) {
  const Policy policy = policy_of("allow local read,command,configure *");
  EXPECT_TRUE(policy.allows({"unix", "", "Vision", Access::kConfigure}));
  EXPECT_TRUE(policy.allows({"tcp", "", "Vision", Access::kConfigure}));
  EXPECT_FALSE(policy.allows({"tls", "", "Vision", Access::kRead}));
  EXPECT_FALSE(policy.allows(by_tls("local", Access::kRead, "Vision")));
}

TEST(Policy, APageIsNoneOfTheOthersOfThisMachine) {
  const AccessQuestion page{"ws", "page", "Vision", Access::kRead};
  EXPECT_EQ(who(page), "page@web");
  EXPECT_TRUE(policy_of("allow page@web read Vision").allows(page));
  EXPECT_TRUE(policy_of("allow *@web read *").allows(page));
  for (const char* text : {"allow local read *", "allow local:* read *", "allow local:page read *",
                           "allow *@tls read *", "allow page@tls read *"}) {
    EXPECT_FALSE(policy_of(text).allows(page)) << text;
  }
  EXPECT_FALSE(policy_of("allow page@web read *").allows({"tcp", "", "Vision", Access::kRead}));
  EXPECT_THAT(mistakes_of("allow anna@web read *"), HasSubstr("page@web"));
}

TEST(Policy, AProgramThatComesLikeAPageWithACertificateIsWhoItIsOverTls) {
  const AccessQuestion anna{"wss", "anna@tls", "Vision", Access::kRead};
  EXPECT_EQ(who(anna), "anna@tls");
  EXPECT_TRUE(policy_of("allow anna@tls read Vision").allows(anna));
  EXPECT_FALSE(policy_of("allow *@web read Vision").allows(anna));
  EXPECT_EQ(who({"tls", "anna@tls", "Vision", Access::kRead}), "anna@tls@tls");
}

TEST(Policy, AnAccountIsWhoTheKernelVouchesFor) {
  const auto from = [](std::string_view transport, std::string_view identity) {
    return AccessQuestion{transport, identity, "Vision", Access::kCommand};
  };
  const Policy one = policy_of("allow local:pilot command *");
  EXPECT_TRUE(one.allows(from("unix", "pilot")));
  EXPECT_FALSE(one.allows(from("unix", "guest")));
  EXPECT_FALSE(one.allows(from("tcp", ""))) << "it proves nothing";
  EXPECT_FALSE(one.allows(from("tls", "pilot")));
  const Policy all = policy_of("allow local:* command *");
  EXPECT_TRUE(all.allows(from("unix", "guest")));
  EXPECT_FALSE(all.allows(from("tcp", "")));
  const Policy anyone = policy_of("allow local command *");
  EXPECT_TRUE(anyone.allows(from("unix", "guest")));
  EXPECT_TRUE(anyone.allows(from("tcp", "")));
}

TEST(Policy, AStarIsEveryoneOfATransportOrEveryone) {
  const Policy of_tls = policy_of("allow *@tls read *");
  EXPECT_TRUE(of_tls.allows(by_tls("anna", Access::kRead, "Vision")));
  EXPECT_FALSE(of_tls.allows({"unix", "", "Vision", Access::kRead}));
  const Policy of_all = policy_of("allow * read Vision");
  EXPECT_TRUE(of_all.allows(by_tls("anna", Access::kRead, "Vision")));
  EXPECT_TRUE(of_all.allows({"unix", "", "Vision", Access::kRead}));
}

TEST(Policy, AnyRuleThatAllowsItIsEnoughInWhateverOrder) {
  for (const char* const text : {"allow *@tls read *\nallow anna@tls command Arm\n",
                                 "allow anna@tls command Arm\r\nallow *@tls read *\r\n"}) {
    const Policy policy = policy_of(text);
    EXPECT_TRUE(policy.allows(by_tls("anna", Access::kRead, "Vision")));
    EXPECT_TRUE(policy.allows(by_tls("anna", Access::kCommand, "Arm")));
    EXPECT_FALSE(policy.allows(by_tls("anna", Access::kCommand, "Vision")));
    EXPECT_FALSE(policy.allows(by_tls("berta", Access::kCommand, "Arm")));
  }
}

TEST(Policy, TellsAllMistakesInOneRunWithTheirPlaces) {
  EXPECT_EQ(mistakes_of("alow local read *\n"
                        "deny local read *\n"
                        "allow opertor read *\n"
                        "allow anna@tsl read *\n"
                        "allow loca read *\n"
                        "  allow local red,comand Vision\n"
                        "allow local read Vision, Arm\n"
                        "allow local read\n"
                        "allow\n"
                        "allow local read,read Vision,*\n"),
            "policy.txt:1:1: error: expected a rule, allow WHO ACCESS COMPONENTS, found 'alow' "
            "(did you mean 'allow'?)\n"
            "policy.txt:2:1: error: expected a rule, allow WHO ACCESS COMPONENTS, found 'deny' "
            "(leave it out: only what a rule allows is allowed)\n"
            "policy.txt:3:7: error: expected NAME@tls, *@tls, page@web, foxglove@web, local:USER, "
            "local or *, "
            "found 'opertor' "
            "(did you mean 'opertor@tls'?)\n"
            "policy.txt:4:7: error: expected NAME@tls, *@tls, page@web, foxglove@web, local:USER, "
            "local or *, "
            "found 'anna@tsl' "
            "(did you mean 'anna@tls'?)\n"
            "policy.txt:5:7: error: expected NAME@tls, *@tls, page@web, foxglove@web, local:USER, "
            "local or *, "
            "found 'loca' "
            "(did you mean 'local'?)\n"
            "policy.txt:6:15: error: expected read, command or configure, found 'red' "
            "(did you mean 'read'?)\n"
            "policy.txt:6:19: error: expected read, command or configure, found 'comand' "
            "(did you mean 'command'?)\n"
            "policy.txt:7:25: error: expected a component's name at the comma "
            "(write Vision,Arm or *)\n"
            "policy.txt:7:26: error: expected the end of the rule, found 'Arm' "
            "(write a list with commas and no space: Vision,Arm)\n"
            "policy.txt:8:17: error: the rule lacks its COMPONENTS "
            "(a rule is allow WHO ACCESS COMPONENTS, as in: allow operator@tls read,command "
            "Vision)\n"
            "policy.txt:9:6: error: the rule lacks its WHO "
            "(a rule is allow WHO ACCESS COMPONENTS, as in: allow operator@tls read,command "
            "Vision)\n"
            "policy.txt:10:18: error: 'read' is given twice (leave one out)\n"
            "policy.txt:10:23: error: expected names or *, found both in 'Vision,*' "
            "(write * alone for all components)\n");
}

TEST(Policy, WithOneMistakeNothingIsAllowed) {
  mistakes_of("allow local read *\nallow locl read *\n");
}

TEST(Policy, WhatIsFoundInAFileCommandsNoTerminal) {
  EXPECT_THAT(mistakes_of("\x1b[2J local read *"), HasSubstr("found '\\x1b[2J'"));
}

TEST(Policy, AFileThatIsNotThereIsAMistake) {
  base::Diagnostics diagnostics;
  EXPECT_TRUE(Policy::load("/no/such/policy", diagnostics).rules().empty());
  EXPECT_THAT(diagnostics.to_text(),
              HasSubstr("/no/such/policy: error: the policy cannot be read"));
}

TEST(Policy, WarnsOfComponentsThatAreNotThere) {
  base::Diagnostics diagnostics;
  policy_of("allow local read Vison,Arm\nallow * read *\n").check({"Vision", "Arm"}, diagnostics);
  EXPECT_TRUE(diagnostics.ok());
  EXPECT_EQ(diagnostics.to_text(),
            "policy.txt:1:18: warning: unknown component 'Vison' (did you mean 'Vision'?)\n");
}

TEST(Policy, WrittenAndReadItIsTheSame) {
  const char* const text = "allow anna@tls read,command Vision,Arm\nallow local configure *\n";
  EXPECT_EQ(policy_of(text).to_text(), text);
}

/// Answers and tells whether it was commanded.
class Watched : public VisionService {
 public:
  void start() override { started = true; }
  std::atomic<bool> started{false};
};

TEST(PolicyOfANode, ACommandThatIsNotAllowedIsRefusedLoggedAndNotExecuted) {
  std::mutex mutex;
  std::condition_variable told;
  std::string log;
  NodeOptions options;
  options.allows = [policy = policy_of("allow local read Vision")](const AccessQuestion& question) {
    return policy.allows(question);
  };
  options.log = [&](const rt::LogRecord& record) {
    const std::lock_guard lock(mutex);
    log += record.message() + "\n";
    told.notify_all();
  };
  Watched vision;
  Watched other;
  Node server(options);
  ASSERT_TRUE(server.add("Vision", vision).ok());
  ASSERT_TRUE(server.add("Other", other).ok());
  const std::string file = server.listen("tcp://127.0.0.1:0").value().text();
  Node client;
  VisionPlaceholder at_vision(client.connect(file), "Vision");
  VisionPlaceholder at_other(client.connect(file), "Other");

  EXPECT_EQ(at_vision.start(), Sent::kYes);
  const auto told_by_other = at_other.on_ObjectPosition([](const ObjectPosition&) {});
  const CallOptions patient{.deadline = 20s, .priority = {}};
  EXPECT_EQ(at_vision.echo("hello", patient).value(), "hello");
  const auto refused = at_vision.initialize(patient);
  EXPECT_EQ(refused.code(), Code::kNotAllowed);
  EXPECT_THAT(refused.error(), HasSubstr("local may not configure 'Vision'"));
  EXPECT_EQ(at_other.echo("hello", patient).code(), Code::kNotAllowed);
  EXPECT_FALSE(vision.started);

  std::unique_lock lock(mutex);
  for (const char* const line :
       {"was refused a COMMAND: NOT_ALLOWED (local may not command 'Vision')",
        "was refused a REQUEST: NOT_ALLOWED (local may not configure 'Vision')",
        "was refused a REQUEST: NOT_ALLOWED (local may not read 'Other')",
        "was refused a subscription: NOT_ALLOWED (local may not read 'Other')"}) {
    EXPECT_TRUE(told.wait_for(lock, 20s, [&] { return log.find(line) != std::string::npos; }))
        << line << "\n"
        << log;
  }
}

TEST(PolicyOfANode, KnowsTheAccountAtASocketFileWhichIsItsOwnersAlone) {
  std::mutex mutex;
  std::set<std::string> askers;
  NodeOptions options;
  options.allows = [&](const AccessQuestion& question) {
    const std::lock_guard lock(mutex);
    askers.insert(who(question));
    return true;
  };
  Watched vision;
  const std::string file = testing::TempDir() + "ride_account_" + std::to_string(::getpid());
  const auto mode_with = [&](unsigned mode) {
    options.socket_mode = mode;
    Node server(options);
    EXPECT_TRUE(server.add("Vision", vision).ok());
    EXPECT_TRUE(server.listen("unix:" + file).ok());
    Node client;
    VisionPlaceholder at_vision(client.connect("unix:" + file), "Vision");
    const CallOptions patient{.deadline = 20s, .priority = {}};
    EXPECT_EQ(at_vision.echo("hello", patient).value(), "hello");
    const auto permissions = std::filesystem::status(file).permissions();
    server.remove(vision);
    return static_cast<unsigned>(permissions);
  };
  EXPECT_EQ(mode_with(NodeOptions().socket_mode), 0600u);
  EXPECT_EQ(mode_with(0660), 0660u);
  const passwd* const account = ::getpwuid(::geteuid());
  const std::string name = account != nullptr ? account->pw_name : std::to_string(::geteuid());
  EXPECT_THAT(askers, testing::ElementsAre("local:" + name));
}

TEST(PolicyOfANode, WhereOtherMachinesReachItANodeNeedsOne) {
  class Proving final : public Transport {
   public:
    std::string scheme() const override { return "proving"; }
    bool safe(const Address&) const override { return true; }
    base::Result<std::unique_ptr<Listener>> listen(const Address&) override {
      return base::Error{"this one never listens"};
    }
    base::Result<std::unique_ptr<Connection>> connect(const Address&) override {
      return base::Error{"this one never connects"};
    }
  };
  NodeOptions options;
  options.transports.push_back(std::make_shared<Proving>());
  Node open(options);
  EXPECT_THAT(open.listen("proving://0.0.0.0:1").error(),
              HasSubstr("no policy says what they may"));
  EXPECT_EQ(open.listen("proving://127.0.0.1:1").error(), "this one never listens");
  options.allows = [](const AccessQuestion&) { return false; };
  Node with_policy(options);
  EXPECT_EQ(with_policy.listen("proving://0.0.0.0:1").error(), "this one never listens");
}

}  // namespace
}  // namespace armature::ride
