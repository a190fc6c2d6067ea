#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/node/node_parameters.h"
#include "interpolated_motion_driver/node/xmlrpc_to_yaml.h"

namespace interpolated_motion::node {
namespace {

/// What parse_node_parameters() says against `yaml`; empty if nothing.
std::string refusal(const std::string& yaml) {
  try {
    parse_node_parameters(YAML::Load(yaml));
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

void expect_refused(const std::string& yaml, const std::vector<std::string>& words) {
  const std::string text = refusal(yaml);
  for (const std::string& word : words) {
    EXPECT_NE(text.find(word), std::string::npos) << yaml << " -> " << text;
  }
}

TEST(NodeParameters, DefaultsAreThoseOfJointTrajectoryController) {
  const NodeParameters parameters = parse_node_parameters(YAML::Load("{}"));
  EXPECT_EQ(parameters.state_publish_rate, 50.0);
  EXPECT_EQ(parameters.action_monitor_rate, 20.0);
  EXPECT_FALSE(parameters.allow_fault_injection);
  EXPECT_FALSE(parameters.allow_parameter_writes);
}

TEST(NodeParameters, TakesWholeNumbersForNumbers) {
  EXPECT_EQ(parse_node_parameters(YAML::Load("{state_publish_rate: 100}")).state_publish_rate, 100.0);
}

TEST(NodeParameters, NamesParameterValueAndRange) {
  expect_refused("{state_publish_rate: fast}", {"state_publish_rate", "fast", "0.1", "1000", "Hz"});
  expect_refused("{state_publish_rate: 0}", {"state_publish_rate", "\"0\"", "0.1", "1000"});
  expect_refused("{state_publish_rate: .nan}", {"state_publish_rate", ".nan"});
  expect_refused("{status_publish_rate: [1, 2]}", {"status_publish_rate", "[1, 2]"});
  expect_refused("{loop_period: 1}", {"loop_period", "0.0005", "0.1"});
  expect_refused("{realtime_priority: 100}", {"realtime_priority", "100", "0", "99"});
  expect_refused("{realtime_priority: 1.5}", {"realtime_priority", "1.5"});
  expect_refused("{allow_fault_injection: perhaps}", {"allow_fault_injection", "perhaps", "true or false"});
  expect_refused("{publish_tf: perhaps}", {"publish_tf", "perhaps", "true or false"});
  expect_refused("{tf_demand_prefix: /demand}", {"tf_demand_prefix", "/demand", "slash"});
  expect_refused("{wire_log: {a: b}}", {"wire_log", "a text"});
}

TEST(NodeParameters, MentionsOnlyTheControllerKeysThatArePresent) {
  const std::vector<std::string> expected{"type", "gains"};
  EXPECT_EQ(ignored_controller_keys(YAML::Load("{type: x, gains: {joint1: {p: 1}}, joints: [joint1]}")),
            expected);
}

XmlRpc::XmlRpcValue nested() {
  XmlRpc::XmlRpcValue value;
  value["joints"][0] = "joint1";
  value["joints"][1] = "joint2";
  value["enable_on_start"] = true;
  value["node_id"] = 7;
  value["sync_period"] = 0.1;
  value["text_number"] = "1e-3";
  return value;
}

TEST(XmlRpcToYaml, KeepsStructureAndValues) {
  const YAML::Node yaml = xmlrpc_to_yaml(nested());
  ASSERT_TRUE(yaml.IsMap());
  ASSERT_TRUE(yaml["joints"].IsSequence());
  EXPECT_EQ(yaml["joints"][1].as<std::string>(), "joint2");
  EXPECT_TRUE(yaml["enable_on_start"].as<bool>());
  EXPECT_EQ(yaml["node_id"].as<int>(), 7);
  EXPECT_EQ(yaml["sync_period"].as<double>(), 0.1);
  EXPECT_EQ(yaml["text_number"].as<double>(), 1e-3);
}

TEST(XmlRpcToYaml, KeepsAllDigitsOfADouble) {
  const double third = 1.0 / 3.0;
  EXPECT_EQ(xmlrpc_to_yaml(XmlRpc::XmlRpcValue(third)).as<double>(), third);
}

TEST(XmlRpcToYaml, RefusesWhatYamlDoesNotHave) {
  char bytes[] = {1, 2, 3};
  XmlRpc::XmlRpcValue binary(bytes, 3);
  EXPECT_THROW(xmlrpc_to_yaml(binary), std::invalid_argument);
}

}  // namespace
}  // namespace interpolated_motion::node
