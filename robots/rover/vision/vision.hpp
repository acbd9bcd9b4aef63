// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/base/changes.hpp"
#include "armature/vision/ball_finder.hpp"
#include "robots/rover/image_size.hpp"

namespace armature::rover {

/// The visual component VS of paper 4 (section IV.A, table 4, figures 5 and 6): recognises a ball
/// by its colour in each image that comes. Positions are counted from the picture's lower left
/// corner.
///
/// An image that equals the one before says nothing new, so it gives no position. After some of
/// them, or without images, the camera has failed: the component tells by `Failed`, RIDE's own
/// event, and recognises nothing until `initialize` finds the camera well and `start` is commanded.
/// @rt its handlers: nonblocking, no allocation
class Vision final : public component::Component {
 public:
  using Component::Component;

  /// What `initialize` and `setThreshold` return.
  static constexpr std::int32_t kDone = 0;
  static constexpr std::int32_t kCameraGone = 1;  ///< of `initialize`
  static constexpr std::int32_t kNoColour = 1;    ///< of `setThreshold`
  static constexpr std::int32_t kNotRunning = 2;  ///< of `initialize`

 private:
  using Images = component::InputPort<std::vector<std::uint8_t>>;
  using OperationName = base::FixedText<31>;
  using Why = base::FixedText<127>;

  void on_check(component::Check& check) const override;
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_update() override { watch_camera(); }

  std::int32_t initialize();
  std::int32_t set_threshold(std::uint32_t red, std::uint32_t green, std::uint32_t blue);
  component::Outcome begin();
  component::Outcome end();

  void look(const std::vector<std::uint8_t>& image);
  bool is_equal(const std::vector<std::uint8_t>& image) const;
  void recognise(const std::vector<std::uint8_t>& image);
  void watch_camera();
  std::string_view complaint() const;

  void say_nothing_is_seen() { seen_.write(false); }
  void tell_initialize_failed() { tell_failed("initialize"); }
  void tell_start_failed() { tell_failed("start"); }
  void tell_failed(std::string_view operation);

  vision::BallFinder::Config config() const;
  component::Outcome make_finder();

  component::Property<int> width_{this, "ImageWidth", 320, "of the images that come",
                                  "px", kImageSide};
  component::Property<int> height_{this, "ImageHeight", 240, "likewise", "px", kImageSide};
  component::Property<int> red_{
      this, "Red", 255, "of the ball's colour; setThreshold sets it", "", component::range(0, 255)};
  component::Property<int> green_{this, "Green", 0, "likewise", "", component::range(0, 255)};
  component::Property<int> blue_{this, "Blue", 0, "likewise", "", component::range(0, 255)};
  component::Property<double> hue_tolerance_{
      this,  "HueTolerance",
      0.2,   "hues as near to that of the colour belong to it",
      "rad", component::range(0.01, 1.04)};
  component::Property<double> min_saturation_{
      this, "MinSaturation", 0.4, "pixels below are grey", "", component::range(0.01, 1.0)};
  component::Property<double> min_value_{
      this, "MinValue", 0.15, "pixels below are black", "", component::range(0.01, 1.0)};
  component::Property<int> min_area_{
      this, "MinArea", 20, "what is smaller is no ball", "px", component::range(1, 1e6)};
  component::Property<double> image_timeout_{
      this, "ImageTimeout",
      0.5,  "without an image for longer, the camera is gone",
      "s",  component::range(0.001, 3600.0)};
  component::Property<int> max_equal_images_{
      this, "MaxEqualImages",        10, "so many in a row that equal the one before: it is frozen",
      "",   component::range(1, 1e6)};

  ImageSize size_{this, width_, height_};
  Images image_{this,
                "Image",
                "red, green, blue of each pixel, the upper row first",
                "",
                component::on_data<&Vision::look>,
                component::on_lost(component::Reaction::kHold),
                component::size_of(size_.bytes())};

  component::OutputPort<double> x_{this, "X", "the ball's centre, from the picture's left edge",
                                   "px"};
  component::OutputPort<double> y_{this, "Y", "upwards from its lower edge", "px"};
  component::OutputPort<double> area_{this, "Area", "of the ball in the picture", "px"};
  component::OutputPort<bool> seen_{this, "Seen", "the last image has the ball"};
  component::OutputPort<int> equal_images_{this, "EqualImages",
                                           "that equalled the one before, since the start"};

  component::Event<std::int32_t, std::int32_t> position_{
      this,
      "ObjectPositionEvent",
      "the ball is there: from the picture's lower left corner",
      {"x [px]", "y [px]"}};
  component::Event<OperationName, Why> failed_{this,
                                               "Failed",
                                               "what was asked for cannot go on",
                                               component::occasional,
                                               {"operation", "why"}};

  component::Operation<std::int32_t()> initialize_{
      this, "initialize", component::serve<&Vision::initialize>,
      "0 if images come, 1 if the camera is gone, 2 if this component does not run",
      component::in_own_thread};
  component::Operation<std::int32_t(std::uint32_t, std::uint32_t, std::uint32_t)> set_threshold_{
      this,
      "setThreshold",
      component::serve<&Vision::set_threshold>,
      "the ball's colour, 0 to 255; 0 if it is one, 1 if it is not or is grey",
      component::in_own_thread,
      component::args("red", "green", "blue")};
  component::Command<> start_{this, "start", component::serve<&Vision::begin>,
                              "begins the recognition"};
  component::Command<> stop_{this, "stop", component::serve<&Vision::end>, "ends it"};

  component::Trigger initialized_{"initialize"};
  component::Trigger started_{"start"};
  component::Trigger stopped_{"stop"};
  component::Trigger found_{"found"};
  component::Trigger missed_{"missed"};
  component::Trigger lost_{"camera lost"};
  component::StateMachine machine_{
      this,
      "recognition",
      "paper 4, figure 6",
      component::in_state("Off", component::on(initialized_, component::to("Ready")),
                          component::on(lost_, component::to("Failed"))),
      component::in_state("Ready", component::on(started_, component::to("Recognising")),
                          component::on(lost_, component::doing<&Vision::tell_initialize_failed>,
                                        component::to("Failed"))),
      component::in_state(
          "Recognising", component::leaving<&Vision::say_nothing_is_seen>,
          component::on(stopped_, component::to("Ready")),
          component::on(initialized_, component::to("Ready")),
          component::on(lost_, component::doing<&Vision::tell_start_failed>,
                        component::to("Failed")),
          component::in_state("Searching",
                              component::on(found_, component::to("Recognising/Tracking"))),
          component::in_state("Tracking",
                              component::on(missed_, component::to("Recognising/Searching")))),
      component::in_state("Failed", "until initialize finds the camera well",
                          component::on(initialized_, component::to("Ready")))};

  std::optional<vision::BallFinder> finder_;
  controllers::Changes changes_{red_,       green_,   blue_, hue_tolerance_, min_saturation_,
                                min_value_, min_area_};
  std::vector<std::uint8_t> last_image_;
  bool has_image_ = false;
  base::Time last_image_at_{};  ///< or the start
  int equal_in_a_row_ = 0;
};

}  // namespace armature::rover
