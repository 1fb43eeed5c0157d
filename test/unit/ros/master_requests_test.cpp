// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/master_requests.h"

#include <gtest/gtest.h>

namespace datmo::master_requests_test {
namespace {

using XmlRpc::XmlRpcValue;

/// The answer to one of the requests: code, message, content.
XmlRpcValue answer(int code, const XmlRpcValue& content) {
  XmlRpcValue wrapped;
  wrapped[0][0] = code;
  wrapped[0][1] = "Parameter [/name]";
  wrapped[0][2] = content;
  return wrapped;
}

XmlRpcValue fault() {
  XmlRpcValue value;
  value["faultCode"] = 1;
  value["faultString"] = "no such method";
  return value;
}

TEST(MasterRequests, EachHasItsAnswer) {
  constexpr int kSuccess = 1;
  constexpr int kRefused = -1;
  XmlRpcValue response;
  response[0] = answer(kSuccess, XmlRpcValue(7));
  response[1] = answer(kRefused, XmlRpcValue(0));
  response[2] = fault();
  const auto answers = answersIn(response, 3);
  ASSERT_TRUE(answers);
  ASSERT_EQ(answers->size(), 3U);
  ASSERT_TRUE(answers->at(0));
  EXPECT_EQ(XmlRpcValue(*answers->at(0)), XmlRpcValue(7));
  EXPECT_FALSE(answers->at(1)) << "an unset parameter";
  EXPECT_FALSE(answers->at(2));
}

TEST(MasterRequests, AResponseOfAnotherFormIsNone) {
  EXPECT_FALSE(answersIn(fault(), 1)) << "a master that takes single requests only";
  EXPECT_FALSE(answersIn(XmlRpcValue(), 1)) << "no response";
  XmlRpcValue single;
  single[0] = 1;
  single[1] = "";
  single[2] = 7;
  EXPECT_FALSE(answersIn(single, 3));
  XmlRpcValue response;
  response[0] = answer(1, XmlRpcValue(7));
  EXPECT_FALSE(answersIn(response, 2));
}

}  // namespace
}  // namespace datmo::master_requests_test
