// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/sync/source_matcher.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace datmo::source_matcher_test {
namespace {

using Matcher = SourceMatcher<int>;

Stamp at(double seconds) { return Stamp::fromSeconds(100.0 + seconds); }

/// What GridMatcherTest does not cover: samples that are used once. A lidar and a stereo camera;
/// accepts samples within 0.06 s, gives up on a source after 0.5 s.
class SourceMatcherTest : public testing::Test {
 protected:
  static SourceMatcherOptions options() {
    SourceMatcherOptions options;
    options.tolerance = 0.06;
    return options;
  }

  void lidar(double seconds) { add("lidar", seconds); }
  void stereo(double seconds) { add("stereo", seconds); }
  void add(const std::string& source, double seconds) {
    matcher_.add(source, at(seconds), std::make_shared<const int>(0));
  }

  /// "lidar 0.1, stereo 0.12" or "stereo 0.3, lidar silent"; empty if nothing is ready.
  std::string next(double now) { return textOf(matcher_.next(at(now))); }

  /// The same for early(): of all waiting samples, or of those after a time.
  std::string early(double now) { return textOf(matcher_.early(std::nullopt, at(now))); }
  std::string early(double now, double after) { return textOf(matcher_.early(at(after), at(now))); }

  static std::string textOf(const std::optional<Matcher::Matched>& matched) {
    std::string text;
    if (!matched) {
      return text;
    }
    for (const SourceSample<int>& one : matched->samples) {
      const double seconds = secondsBetween(at(0.0), one.stamp);
      text += (text.empty() ? "" : ", ") + one.source + " " + toText(OptionValue(seconds));
    }
    for (const MissingSource& missing : matched->missing) {
      text += ", " + missing.source + " " + toText(missing.why);
    }
    return text;
  }

  Matcher matcher_{options(), {"stereo", "lidar"}, Serving::kOnce};
};

TEST_F(SourceMatcherTest, WaitingSamplesAreAvailableEarly) {
  lidar(0.0);
  EXPECT_EQ(next(0.0), "");
  EXPECT_EQ(early(0.0), "lidar 0, stereo none near");
  EXPECT_EQ(early(0.0, 0.0), "") << "none after this one";
  lidar(0.06);
  EXPECT_EQ(early(0.06, 0.0), "lidar 0.06, stereo none near");
}

TEST_F(SourceMatcherTest, EarlySamplesAreStillMatchedLater) {
  lidar(0.0);
  EXPECT_NE(early(0.0), "");
  stereo(0.02);
  EXPECT_EQ(early(0.02), "lidar 0, stereo 0.02") << "ready, and not asked for yet";
  EXPECT_EQ(next(0.02), "lidar 0, stereo 0.02");
  EXPECT_EQ(early(0.02), "");
  EXPECT_EQ(matcher_.unserved("stereo"), 0U);
}

TEST_F(SourceMatcherTest, AnEarlySampleIsUsedOnce) {
  lidar(0.0);
  lidar(0.04);
  stereo(-0.01);
  EXPECT_EQ(early(0.04), "lidar 0, stereo -0.01");
  EXPECT_EQ(early(0.04, 0.0), "lidar 0.04, stereo none near");
}

TEST(LateSource, DelaysNoSetAndCountsOnArrival) {
  Matcher matcher({}, {"lidar", "mono"}, Serving::kOnce, {{"mono", 0.3}});
  const auto add = [&matcher](const char* source, double seconds) {
    matcher.add(source, at(seconds), std::make_shared<const int>(0));
  };
  add("lidar", 0.0);
  const auto alone = matcher.next(at(0.0));
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->samples.size(), 1U);
  add("mono", -0.1);  // later than a scan
  EXPECT_FALSE(matcher.next(at(0.0)));
  add("lidar", 0.1);
  const auto both = matcher.next(at(0.1));
  ASSERT_TRUE(both);
  ASSERT_EQ(both->samples.size(), 2U);
  EXPECT_EQ(both->samples[1].stamp, at(-0.1));
  add("lidar", 0.2);
  EXPECT_EQ(matcher.next(at(0.2))->samples.size(), 1U) << "once";
}

TEST(LateSource, LateSamplesAreInNoSet) {
  Matcher matcher({}, {"lidar", "mono"}, Serving::kOnce, {{"mono", 0.3}});
  matcher.add("mono", at(-0.35), std::make_shared<const int>(0));
  matcher.add("lidar", at(0.0), std::make_shared<const int>(0));
  EXPECT_EQ(matcher.next(at(0.0))->samples.size(), 1U);
  EXPECT_EQ(matcher.unserved("mono"), 1U);
}

TEST_F(SourceMatcherTest, ThePayloadIsPassedThrough) {
  const auto payload = std::make_shared<const int>(7);
  matcher_.add("lidar", at(0.0), payload);
  stereo(0.0);
  const auto matched = matcher_.next(at(0.0));
  ASSERT_TRUE(matched);
  EXPECT_EQ(matched->reference().payload, payload);
}

TEST_F(SourceMatcherTest, ASampleIsUsedOnce) {
  stereo(0.04);
  lidar(0.0);
  EXPECT_EQ(next(0.04), "lidar 0, stereo 0.04");
  lidar(0.08);
  stereo(0.2);
  EXPECT_EQ(next(0.2), "lidar 0.08, stereo none near");
}

TEST_F(SourceMatcherTest, ASampleIsKeptForTheNearerOneOfTheReference) {
  lidar(0.0);
  lidar(0.1);
  stereo(0.055);
  EXPECT_EQ(next(0.1), "lidar 0, stereo none near");
  EXPECT_EQ(next(0.1), "") << "a nearer one may come yet";
  stereo(0.2);
  EXPECT_EQ(next(0.2), "lidar 0.1, stereo 0.055");
}

TEST_F(SourceMatcherTest, OfEquallyNearOnesOfTheReferenceTheEarlierHasIt) {
  lidar(0.0);
  lidar(0.1);
  stereo(0.05);
  EXPECT_EQ(next(0.1), "lidar 0, stereo 0.05");
}

TEST_F(SourceMatcherTest, ASampleThatLedASetIsInNoOther) {
  lidar(0.0);
  EXPECT_EQ(next(0.1), "lidar 0, stereo none near");
  stereo(0.02);
  for (const double seconds : {0.2, 0.4, 0.5}) {
    stereo(seconds);
  }
  EXPECT_EQ(next(0.5), "stereo 0.02, lidar silent") << "the lidar's last would have been near";
}

TEST_F(SourceMatcherTest, AUsedSampleDoesNotLead) {
  lidar(0.0);
  stereo(0.04);
  EXPECT_EQ(next(0.04), "lidar 0, stereo 0.04");
  stereo(0.3);
  stereo(0.5);
  EXPECT_EQ(next(0.5), "stereo 0.3, lidar silent");
}

TEST_F(SourceMatcherTest, NoSampleIsOlderThanTheLastUsedOneOfItsSource) {
  stereo(0.0);
  stereo(0.04);
  lidar(0.05);
  stereo(0.07);
  EXPECT_EQ(next(0.07), "lidar 0.05, stereo 0.04");
  lidar(0.06);
  EXPECT_EQ(next(0.07), "lidar 0.06, stereo 0.07");
  lidar(0.065);
  stereo(0.2);
  EXPECT_EQ(next(0.2), "lidar 0.065, stereo none near") << "not the one of 0 s";
}

TEST_F(SourceMatcherTest, ASlowerSourceIsMatchedOnceASample) {
  std::set<std::int64_t> served;
  int sets = 0;
  int without = 0;
  for (int i = 0; i < 1600; ++i) {
    const double now = 0.01 * i;
    if (i % 6 == 0) {
      lidar(now);
    }
    if (i % 10 == 0) {
      stereo(now);
    }
    while (const auto matched = matcher_.next(at(now))) {
      ++sets;
      if (matched->samples.size() < 2) {
        ++without;
        continue;
      }
      const Stamp stamp = matched->samples[1].stamp;
      EXPECT_TRUE(served.insert(stamp.nanoseconds).second) << secondsBetween(at(0.0), stamp);
      EXPECT_LE(std::abs(secondsBetween(stamp, matched->stamp())), 0.06);
    }
  }
  EXPECT_GE(sets, 265);
  EXPECT_GE(served.size(), 158U) << "each of them but the last";
  EXPECT_EQ(sets - without, static_cast<int>(served.size()));
  EXPECT_EQ(matcher_.unserved("stereo"), 0U);
}

TEST_F(SourceMatcherTest, UnmatchedSamplesAreCounted) {
  for (const double seconds : {0.0, 0.03, 0.06, 0.09}) {
    stereo(seconds);
  }
  lidar(0.0);
  EXPECT_EQ(next(0.09), "lidar 0, stereo 0");
  EXPECT_EQ(matcher_.unserved("stereo"), 0U) << "they may be yet";
  lidar(0.09);
  EXPECT_EQ(next(0.09), "lidar 0.09, stereo 0.09");
  EXPECT_EQ(matcher_.unserved("stereo"), 2U);
  EXPECT_EQ(matcher_.unserved("lidar"), 0U);
}

TEST_F(SourceMatcherTest, LateSamplesAreCounted) {
  lidar(0.0);
  EXPECT_EQ(next(0.1), "lidar 0, stereo none near");
  lidar(0.1);
  stereo(0.01);
  EXPECT_EQ(next(0.2), "lidar 0.1, stereo none near");
  EXPECT_EQ(matcher_.unserved("stereo"), 1U);
}

TEST_F(SourceMatcherTest, OverflowingSamplesAreCounted) {
  for (int i = 0; i < 1000; ++i) {
    lidar(0.001 * i);
  }
  EXPECT_GT(matcher_.unserved("lidar"), 900U);
}

TEST_F(SourceMatcherTest, AResetForgetsWaitingSamplesAndKeepsTheCount) {
  lidar(50.0);
  stereo(50.0);
  matcher_.reset();
  EXPECT_EQ(matcher_.unserved("lidar"), 1U);
  lidar(0.0);
  EXPECT_EQ(next(0.0), "");
  stereo(0.0);
  EXPECT_EQ(next(0.0), "lidar 0, stereo 0");
}

TEST_F(SourceMatcherTest, RefusesAnUnknownSource) {
  EXPECT_THROW(add("radar", 0.0), std::invalid_argument);
  EXPECT_THROW(matcher_.unserved("radar"), std::out_of_range);
}

TEST(SourceMatcherOptionsTest, AreChecked) {
  SourceMatcherOptions options;
  options.tolerance = -0.1;
  EXPECT_THROW(Matcher(options, {"lidar"}, Serving::kOnce), OptionError);
  EXPECT_THROW(Matcher({}, {"stereo"}, Serving::kOnce), OptionError) << "the reference is lidar";
}

}  // namespace
}  // namespace datmo::source_matcher_test
