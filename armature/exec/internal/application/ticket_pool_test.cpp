// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/ticket_pool.hpp"

#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/exec/internal/application/test_parts.hpp"

namespace armature::exec::internal {
namespace {

/// Its command goes on until somebody cancels it.
class Mover final : public component::Component {
 public:
  using Component::Component;
  component::Command<> move{this, "move", component::serve<&Mover::begin_to_move>, "goes on",
                            component::cancelled_by<&Mover::cancel>};
  int cancelled = 0;

 private:
  component::Outcome begin_to_move() { return component::accepted(); }
  void cancel() { ++cancelled; }
};

class TicketPoolTest : public ::testing::Test {
 protected:
  TicketPoolTest() {
    EXPECT_TRUE(component::Host::configure(mover()));
    EXPECT_TRUE(component::Host::activate(mover()));
    EXPECT_TRUE(component::Host::start(mover()));
  }
  static Blueprint one_mover() {
    Blueprint blueprint;
    blueprint.add<Mover>("Mover", Activity::triggered());
    return blueprint;
  }
  /// As its component does: it shares the ticket until then.
  static void end(ToolTicket& ticket) {
    ticket.end(component::CommandStage::kDone, component::Reason());
  }
  Mover& mover() { return static_cast<Mover&>(parts_.component(0)); }

  PlannedParts parts_{one_mover()};
  TicketPool pool_;
};

TEST_F(TicketPoolTest, GivesNobodyATicketThatAnotherHas) {
  ToolTicket& first = pool_.claim(face(mover().move));
  const component::CommandHandle held(first);
  ToolTicket& second = pool_.claim(face(mover().move));
  const component::CommandHandle held_too(second);
  EXPECT_NE(&second, &first);
  end(first);
  end(second);
}

TEST_F(TicketPoolTest, GivesATicketAgainWhoseCommandHasEndedAndThatNobodyLooksAt) {
  ToolTicket* const first = &pool_.claim(face(mover().move));
  {
    const component::CommandHandle held(*first);
    end(*first);
  }
  ASSERT_EQ(&pool_.claim(face(mover().move)), first);
  const component::CommandHandle held(*first);
  end(*first);
}

TEST_F(TicketPoolTest, CancelsWhatIsUnderWay) {
  EXPECT_FALSE(pool_.cancel_all());
  EXPECT_FALSE(pool_.any_under_way());
  ToolTicket& ticket = pool_.claim(face(mover().move));
  const component::CommandHandle held(ticket);
  ASSERT_TRUE(face(mover().move).begin_with(&ticket, {}).ok());
  EXPECT_TRUE(pool_.any_under_way());
  EXPECT_TRUE(pool_.cancel_all());
  parts_.engine_of(0).step({});
  EXPECT_EQ(mover().cancelled, 1);
  EXPECT_FALSE(pool_.any_under_way());
}

}  // namespace
}  // namespace armature::exec::internal
