// light_lag against its rules, frame by frame.
#include "tests/support/run_node.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace quell::test {
namespace {

enum Output { kState, kFrames, kLagging, kStepped, kOver };

struct Follow {
  float tolerance = 0.1f, least = 0.05f;
  int window = 32;
  std::vector<Image> operator()(const Image& before, const Image& step, const Image& error, float share = 1) const {
    const auto of_frame = constant_image(1, 1, 1, share);
    Node node("light_lag");
    node.set("tolerance", tolerance).set("least", least).set("window", window);
    return node.in("before", before).in("step", step).in("error", error).in("share", of_frame).run();
  }
};

constexpr int kWidth = 19, kHeight = 5;
Image nothing() { return constant_image(kWidth, kHeight, 1, 0); }
Image no_past() { return constant_image(kWidth, kHeight, 5, 0); }

// Pixel x has an error of x/10 of the step in the first frame, which falls by half a frame.
TEST(LightLag, CountsFramesUntilTheStepIsReached) {
  const Follow run;
  auto state = no_past();
  for (int t = 0; t < 6; ++t) {
    auto step = nothing(), error = nothing();
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const float sign = y % 2 ? 1.0f : -1.0f;
        if (t == 0) step.at(0, x, y) = 4 * sign;
        error.at(0, x, y) = 4 * sign * float(0.1 * x * std::pow(0.5, t));
      }
    auto out = run(state, step, error);
    for (int x = 0; x < kWidth; ++x) {
      int frames = 0;
      while (frames <= t && 0.1 * x * std::pow(0.5, frames) > 0.0999) ++frames;
      EXPECT_EQ(out[kFrames].at(0, x, 1), float(frames)) << x << " in frame " << t;
      EXPECT_EQ(out[kLagging].at(0, x, 2), frames == t + 1 ? 1.0f : 0.0f) << x << " in frame " << t;
      EXPECT_EQ(out[kStepped].at(0, x, 0), 1.0f);
    }
    state = std::move(out[kState]);
  }
}

TEST(LightLag, WhatWasReachedOnceIsReached) {
  const Follow run;
  const auto step = constant_image(kWidth, kHeight, 1, 2), wrong = constant_image(kWidth, kHeight, 1, 1);
  auto state = run(no_past(), step, wrong)[kState].copy();
  state = run(state, nothing(), nothing())[kState].copy();
  const auto out = run(state, nothing(), wrong);
  EXPECT_EQ(out[kFrames].at(0, 3, 3), 1.0f);
  EXPECT_EQ(out[kLagging].at(0, 3, 3), 0.0f);
}

TEST(LightLag, EndsWithItsWindow) {
  Follow run;
  run.window = 3;
  const auto wrong = constant_image(kWidth, kHeight, 1, 1), none = nothing();
  auto state = no_past();
  for (int t = 0; t < 5; ++t) {
    auto out = run(state, t ? none : wrong, wrong);
    EXPECT_EQ(out[kFrames].at(0, 4, 4), t < 3 ? float(t + 1) : 0.0f) << t;
    EXPECT_EQ(out[kStepped].at(0, 4, 4), t < 3 ? 1.0f : 0.0f) << t;
    EXPECT_EQ(out[kOver].at(0, 4, 4), t == 2 ? 1.0f : 0.0f) << t;
    state = std::move(out[kState]);
  }
}

TEST(LightLag, BeginsAnewWithAFurtherStep) {
  const Follow run;
  const auto wrong = constant_image(kWidth, kHeight, 1, 1), step = constant_image(kWidth, kHeight, 1, 1);
  auto state = run(no_past(), step, wrong)[kState].copy();
  state = run(state, nothing(), wrong)[kState].copy();
  EXPECT_EQ(run(state, nothing(), wrong)[kFrames].at(0, 0, 0), 3.0f);
  EXPECT_EQ(run(state, step, wrong)[kFrames].at(0, 0, 0), 1.0f);
}

TEST(LightLag, FollowsNoShadowThatPasses) {
  const Follow run;
  const auto step = constant_image(kWidth, kHeight, 1, 1);
  EXPECT_EQ(run(no_past(), step, step, 0.04f)[kStepped].at(0, 0, 0), 0.0f);
  for (const float share : {0.06f, -0.06f})
    EXPECT_EQ(run(no_past(), step, step, share)[kStepped].at(0, 0, 0), 1.0f) << share;
}

// What bilinear taps make of neighbours of which only some follow a step: in proportion.
TEST(LightLag, MixesAsMotionDoes) {
  const Follow run;
  auto step = nothing();
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < 9; ++x) step.at(0, x, y) = 8;
  const auto wrong = constant_image(kWidth, kHeight, 1, 1);
  const auto state = run(no_past(), step, wrong)[kState].copy();
  // Pixel 8 is the last that stepped.
  for (const float kept : {0.75f, 0.25f}) {
    auto moved = state.copy();
    for (int c = 0; c < 5; ++c)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x + 1 < kWidth; ++x)
          moved.at(c, x, y) = kept * state.at(c, x, y) + (1 - kept) * state.at(c, x + 1, y);
    const auto out = run(moved, nothing(), wrong);
    const bool mostly = kept > 0.5f;
    EXPECT_EQ(out[kFrames].at(0, 7, 0), 2.0f);
    EXPECT_EQ(out[kFrames].at(0, 8, 0), mostly ? 2.0f : 0.0f);
    EXPECT_EQ(out[kLagging].at(0, 8, 0), mostly ? 1.0f : 0.0f);
    EXPECT_EQ(out[kStepped].at(0, 8, 0), mostly ? 1.0f : 0.0f);
    EXPECT_EQ(out[kState].at(0, 8, 0), kept) << "it goes on all the same";
    EXPECT_EQ(out[kState].at(1, 8, 0), 8 * kept);
    EXPECT_EQ(out[kStepped].at(0, 9, 0), 0.0f);
  }
}

TEST(LightLag, RefusesAStateThatIsNone) {
  const auto scalar = nothing();
  try {
    Follow()(constant_image(kWidth, kHeight, 3, 0), scalar, scalar);
    FAIL() << "no error";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(),
                 "before has 3 channels, but the state of light_lag has 5: wire its own state, delayed, by way of "
                 "reproject");
  }
}

}  // namespace
}  // namespace quell::test
