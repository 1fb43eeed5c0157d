// SPDX-License-Identifier: BSD-3-Clause
// What dynamic_reconfigure offers is what the stages know.
#include <string>
#include <vector>

#include <datmo_fusion/GridFusionConfig.h>
#include <datmo_fusion/TrackFusionConfig.h>
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/grid/grid_fuser.h"
#include "datmo_fusion/fusion/track/track_fuser.h"

namespace datmo {
namespace {

/// One choice of that name is all that the server sets, and it offers these values.
template <typename Config>
void expectOffers(const std::string& name, const std::vector<std::string>& values) {
  const auto descriptions = Config::__getParamDescriptions__();
  ASSERT_EQ(descriptions.size(), 1U) << "the server sets what it knows: loadOptions must know it";
  EXPECT_EQ(descriptions[0]->name, name);
  std::string choices = descriptions[0]->edit_method;
  for (const std::string& value : values) {
    const std::string choice = "'value': '" + value + "'";
    const auto found = choices.find(choice);
    ASSERT_NE(found, std::string::npos) << value;
    choices.erase(found, choice.size());
  }
  EXPECT_EQ(choices.find("'value'"), std::string::npos) << "no other choice: " << choices;
}

TEST(FusionConfigs, OfferTheRulesThatThereAre) {
  using Config = datmo_fusion::GridFusionConfig;
  EXPECT_EQ(Config::__getDefault__().rule, GridFuserOptions().rule);
  expectOffers<Config>("rule", fusionRuleNames());
}

TEST(FusionConfigs, OfferTheSchemesThatThereAre) {
  using Config = datmo_fusion::TrackFusionConfig;
  EXPECT_EQ(Config::__getDefault__().scheme, TrackFuserOptions().scheme);
  expectOffers<Config>("scheme", trackSchemeNames());
}

}  // namespace
}  // namespace datmo
