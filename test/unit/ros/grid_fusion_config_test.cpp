// What dynamic_reconfigure offers is what grid_fusion knows.
#include <datmo_fusion/GridFusionConfig.h>
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/grid_fuser.h"

namespace datmo {
namespace {

TEST(GridFusionConfig, OffersTheRulesThatThereAre) {
  using Config = datmo_fusion::GridFusionConfig;
  EXPECT_EQ(Config::__getDefault__().rule, GridFuserOptions().rule);
  const auto descriptions = Config::__getParamDescriptions__();
  ASSERT_EQ(descriptions.size(), 1U) << "the server sets what it knows: loadOptions must know it";
  EXPECT_EQ(descriptions[0]->name, "rule");
  std::string choices = descriptions[0]->edit_method;
  for (const std::string& rule : fusionRuleNames()) {
    const std::string choice = "'value': '" + rule + "'";
    const auto found = choices.find(choice);
    ASSERT_NE(found, std::string::npos) << rule;
    choices.erase(found, choice.size());
  }
  EXPECT_EQ(choices.find("'value'"), std::string::npos) << "no other choice: " << choices;
}

}  // namespace
}  // namespace datmo
