#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include "deck_test.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/parse_surface.hpp"
#include "osculate/deck/schema.hpp"
#include "osculate/deck/source_tree.hpp"

namespace osculate::deck {
namespace {

using Json = nlohmann::json;

Json model_schema_json() { return Json::parse(model_schema()); }

/// YAML as an editor hands it to a JSON schema.
Json to_json(const SourceNode& node) {
  Json out;
  if (node.kind == SourceNode::Kind::list) {
    out = Json::array();
    for (const SourceNode& item : node.items) out.push_back(to_json(item));
  } else if (node.kind == SourceNode::Kind::map) {
    out = Json::object();
    for (const SourceEntry& entry : node.entries) out[entry.key] = to_json(entry.value);
  } else if (node.kind == SourceNode::Kind::scalar) {
    const Json value = Json::parse(node.text, nullptr, false);
    out = node.quoted || !value.is_primitive() || value.is_discarded() ? Json(node.text) : value;
  }
  return out;
}

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer")
    return value.is_number_integer() ||
           (value.is_number() && std::floor(value.get<double>()) == value.get<double>());
  return type == "number" && value.is_number();
}

std::string violation(const Json& schema, const Json& value);

int accepted_by(const Json& schemas, const Json& value) {
  int count = 0;
  for (const Json& schema : schemas) count += violation(schema, value).empty() ? 1 : 0;
  return count;
}

std::string object_violation(const Json& schema, const Json& value) {
  for (const Json& key : schema.value("required", Json::array()))
    if (!value.contains(key.get<std::string>())) return "lacks " + key.get<std::string>();
  if (value.size() < schema.value("minProperties", std::size_t{0})) return "too few properties";
  for (const auto& [key, child] : value.items()) {
    std::string wrong;
    if (schema.contains("propertyNames") && !violation(schema["propertyNames"], key).empty())
      return "property name " + key;
    if (schema.contains("properties") && schema["properties"].contains(key))
      wrong = violation(schema["properties"][key], child);
    else if (schema.contains("additionalProperties"))
      wrong = violation(schema["additionalProperties"], child);
    if (!wrong.empty()) return key + ": " + wrong;
  }
  return {};
}

std::string array_violation(const Json& schema, const Json& value) {
  if (value.size() < schema.value("minItems", std::size_t{0})) return "too few items";
  if (value.size() > schema.value("maxItems", value.size())) return "too many items";
  for (const Json& item : value) {
    const std::string wrong = violation(schema.value("items", Json(true)), item);
    if (!wrong.empty()) return "item: " + wrong;
  }
  return {};
}

std::string number_violation(const Json& schema, double value) {
  if (schema.contains("minimum") && value < schema["minimum"]) return "below minimum";
  if (schema.contains("maximum") && value > schema["maximum"]) return "above maximum";
  if (schema.contains("exclusiveMinimum") && value <= schema["exclusiveMinimum"]) return "too low";
  if (schema.contains("exclusiveMaximum") && value >= schema["exclusiveMaximum"]) return "too high";
  return {};
}

bool type_fits(const Json& schema, const Json& value) {
  if (!schema.contains("type")) return true;
  const Json& type = schema["type"];
  if (type.is_string()) return has_type(value, type);
  return std::any_of(type.begin(), type.end(),
                     [&](const Json& one) { return has_type(value, one); });
}

/// The part of JSON schema that our schema uses; empty when the value is accepted.
std::string violation(const Json& schema, const Json& value) {
  if (schema.is_boolean()) return schema.get<bool>() ? "" : "not allowed";
  if (!type_fits(schema, value)) return "wrong type: " + value.dump();
  if (schema.contains("not") && violation(schema["not"], value).empty()) return "not allowed";
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    return "not in enum: " + value.dump();
  if (schema.contains("anyOf") && accepted_by(schema["anyOf"], value) == 0) return "anyOf";
  if (schema.contains("oneOf") && accepted_by(schema["oneOf"], value) != 1) return "oneOf";
  for (const Json& part : schema.value("allOf", Json::array())) {
    const std::string wrong = violation(part, value);
    if (!wrong.empty()) return wrong;
  }
  if (value.is_object()) return object_violation(schema, value);
  if (value.is_array()) return array_violation(schema, value);
  if (value.is_number()) return number_violation(schema, value.get<double>());
  if (value.is_string() && schema.contains("pattern")) {
    const std::string pattern = schema["pattern"];
    if (pattern.find("\\u") == std::string::npos &&  // std::regex knows no code points
        !std::regex_search(value.get<std::string>(), std::regex(pattern)))
      return "pattern";
  }
  return {};
}

TEST(Schema, IsJsonOfTheRightDraft) {
  const Json schema = model_schema_json();
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema["type"], "object");
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["required"], Json::array({"osculate", "mesh", "steps"}));
}

TEST(Schema, MentionsEveryKeyWithADescription) {
  std::set<std::string> described;
  const auto visit = [&](const auto& self, const Json& node) -> void {
    if (node.is_object() && node.contains("properties"))
      for (const auto& [key, child] : node["properties"].items())
        if (child.is_object() && !child.value("description", "").empty()) described.insert(key);
    for (const Json& child : node)
      if (child.is_structured()) self(self, child);
  };
  visit(visit, model_schema_json());
  walk(model_spec(), "", [&](const std::string& path, const Spec& spec) {
    for (const Key& key : spec.keys)
      EXPECT_TRUE(described.contains(key.name)) << path << "." << key.name;
  });
}

TEST(Schema, AcceptsTheGoodModels) {
  const Json schema = model_schema_json();
  for (const char* const file :
       {"block.yaml", "full.yaml", "parts.yaml", "round.yaml", "files.yaml", "solid.yaml",
        "all.yaml", "channel.yaml", "laws.yaml"})
    EXPECT_EQ(violation(schema, to_json(read_yaml(test_file(file), file))), "") << file;
}

TEST(Schema, AcceptsWhatFollowsFromParameters) {
  const Json schema = model_schema_json();
  const std::vector<std::pair<std::string, std::string>> edits{
      {"mu: 0.3", "mu: =2*a"},
      {"mu: 0.3", "mu: \"${a}\""},
      {"increments: 80", "increments: =8*n"},
      {"sampling: nodes", "sampling: {gauss: =n}"},
      {"weight: reference_area", "weight: =kind"},
      {"{set: base_line}", "{set: \"${side}_line\", flip: =turned}"},
      {"center: [0, 9]", "center: [0, =a]"},
  };
  const std::string block = test_file("block.yaml") +
                            "parameters: {a: 0.5, n: 10, kind: reference_area, turned: true, "
                            "side: base}\n";
  for (const auto& [from, to] : edits) {
    const std::string text = edited(block, from, to);
    EXPECT_EQ(refusal(text), "") << to;
    EXPECT_EQ(violation(schema, to_json(read_yaml(text, "m"))), "") << to;
  }
}

// A surface file has no parameters.
TEST(Schema, OfSurfacesAcceptsNumbersOnly) {
  EXPECT_EQ(surface_schema().find("\\$"), std::string::npos);
}

TEST(Schema, RefusesWhatTheParserRefuses) {
  const Json schema = model_schema_json();
  const std::string block = test_file("block.yaml");
  const std::vector<std::pair<std::string, std::string>> edits{
      {"coulomb:", "coulumb:"},
      {"mu: 0.3", "mu: abc"},
      {"mu: 0.3", "mu: -1"},
      {"nu: 0.3", "nu: 0.5"},
      {"    master: bottom\n", ""},
      {"{set: base_line}", "{flip: true}"},
      {"{set: base_line}", "{set: base_line, circle: {center: [0, 0], radius: 1}}"},
      {"uy: -0.007, ux: 0}", "amplitude: wave}"},
      {"center: [0, 9]", "center: [0, 9, 2]"},
      {"weight: reference_area", "weight: areas"},
      {"sampling: nodes", "sampling: {gauss: 0}"},
      {"sampling: nodes", "sampling: {lobatto: 1}"},
      {"sampling: nodes", "sampling: {subdomains: 2}"},
      {"sampling: nodes", "sampling: {gauss: 2, lobatto: 2}"},
      {"max_iterations: 25", "arc_length: 3"},
      {"increments: 80", "increments: 80.5"},
      {"fields: every", "fields: 0"},
      {"[[0, 0], [0.5, 1], [1, 0]]", "[]"},
      {"osculate: 1\n", ""},
      {"osculate: 1", "osculate: 2"},
  };
  for (const auto& edit : edits) {
    const std::string text = edited(block, edit.first, edit.second);
    EXPECT_NE(refusal(text), "") << edit.second;
    EXPECT_NE(violation(schema, to_json(read_yaml(text, "m"))), "") << edit.second;
  }
}

TEST(Schema, DefaultsAndExamplesAreJsonValues) {
  const Json solver = model_schema_json()["properties"]["solver"];
  EXPECT_EQ(solver["default"], Json::object());
  EXPECT_EQ(solver["properties"]["max_iterations"]["default"], 25);
  EXPECT_EQ(solver["properties"]["line_search"]["default"], "auto");
  EXPECT_EQ(solver["properties"]["tolerance"]["properties"]["energy"]["default"], 1e-12);
  EXPECT_EQ(solver["properties"]["line_search"]["anyOf"][0]["enum"], Json::array({"auto", "off"}));
}

}  // namespace
}  // namespace osculate::deck
