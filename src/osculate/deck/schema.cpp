// The only translation unit of this layer that includes nlohmann/json (slow to compile).
#include "osculate/deck/schema.hpp"

#include <nlohmann/json.hpp>

#include "osculate/deck/check.hpp"
#include "osculate/deck/explain.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

using Json = nlohmann::ordered_json;

Json schema_of(const Spec& spec);

/// YAML of a default or an example as JSON; only called with texts of the specification.
Json literal(const SourceNode& node) {
  switch (node.kind) {
    case SourceNode::Kind::nothing:
      return nullptr;
    case SourceNode::Kind::list: {
      Json out = Json::array();
      for (const SourceNode& item : node.items) out.push_back(literal(item));
      return out;
    }
    case SourceNode::Kind::map: {
      Json out = Json::object();
      for (const SourceEntry& entry : node.entries) out[entry.key] = literal(entry.value);
      return out;
    }
    case SourceNode::Kind::scalar:
      break;
  }
  const Json parsed = Json::parse(node.text, nullptr, false);
  const bool plain = !node.quoted && (parsed.is_number() || parsed.is_boolean());
  return plain ? parsed : Json(node.text);
}

void add_bounds(const Spec& spec, Json& out) {
  if (spec.low) out[spec.low->inclusive ? "minimum" : "exclusiveMinimum"] = spec.low->value;
  if (spec.high) out[spec.high->inclusive ? "maximum" : "exclusiveMaximum"] = spec.high->value;
}

Json group_schema(const Group& group) {
  Json branches = Json::array();
  for (const std::string& key : group.keys)
    branches.push_back(Json{{"required", Json::array({key})}});
  return Json{{group.rule == Group::Rule::exactly_one ? "oneOf" : "anyOf", branches}};
}

void add_map(const Spec& spec, Json& out) {
  out["type"] = "object";
  Json properties = Json::object();
  Json required = Json::array();
  for (const Key& key : spec.keys) {
    properties[key.name] = schema_of(key.spec);
    if (key.required) required.push_back(key.name);
  }
  out["properties"] = std::move(properties);
  if (!required.empty()) out["required"] = std::move(required);
  out["additionalProperties"] = false;
  Json all = Json::array();
  for (const Group& group : spec.groups) all.push_back(group_schema(group));
  if (!all.empty()) out["allOf"] = std::move(all);
}

void add_text(const Spec& spec, Json& out) {
  // Plain numbers are accepted as texts, as YAML has no quotes to tell them apart.
  out["type"] = Json::array({"string", "number", "boolean"});
  if (spec.rule == TextRule::any) out["pattern"] = R"([^\s])";
  if (spec.rule == TextRule::name) out["pattern"] = "^[A-Za-z0-9_\\-\\u0080-\\uffff]+$";
  if (spec.rule == TextRule::column) out["pattern"] = "^[^,\"\\r\\n]+$";
}

void add_list(const Spec& spec, Json& out) {
  out["type"] = "array";
  out["items"] = schema_of(spec.parts[0]);
  if (spec.min_items > 0) out["minItems"] = spec.min_items;
  if (spec.max_items != std::numeric_limits<std::size_t>::max()) out["maxItems"] = spec.max_items;
}

void add_type(const Spec& spec, Json& out) {
  switch (spec.type) {
    case Type::map:
      return add_map(spec, out);
    case Type::names:
      out["type"] = "object";
      if (spec.min_items > 0) out["minProperties"] = spec.min_items;
      out["propertyNames"] = Json{{"pattern", "^[A-Za-z0-9_\\-\\u0080-\\uffff]+$"}};
      out["additionalProperties"] = schema_of(spec.parts[0]);
      return;
    case Type::list:
      return add_list(spec, out);
    case Type::text:
      return add_text(spec, out);
    case Type::number:
      out["type"] = "number";
      return add_bounds(spec, out);
    case Type::integer:
      out["type"] = "integer";
      return add_bounds(spec, out);
    case Type::boolean:
      out["type"] = "boolean";
      return;
    case Type::choice:
      out["enum"] = choice_names(spec);
      return;
    case Type::either:
      break;
  }
  Json alternatives = Json::array();
  for (const Spec& part : spec.parts) alternatives.push_back(schema_of(part));
  out["anyOf"] = std::move(alternatives);
}

Json schema_of(const Spec& spec) {
  Json out = Json::object();
  out["description"] = summary(spec);
  if (!spec.available) {
    out["not"] = Json::object();
    return out;
  }
  add_type(spec, out);
  if (!spec.fallback.empty()) out["default"] = literal(read_yaml(spec.fallback, "default"));
  if (!spec.example.empty())
    out["examples"] = Json::array({literal(read_yaml(spec.example, "example"))});
  return out;
}

/// Where there are parameters, any plain value may be a text that follows from them: =2*a, ${a}.
void accept_computed(Json& schema) {
  constexpr const char* computed = R"(^=|\$\{)";
  if (!schema.is_structured()) return;
  for (Json& child : schema) accept_computed(child);
  if (schema.is_array()) return;
  const Json type = schema.value("type", Json());
  if (type == "number" || type == "integer" || type == "boolean") {
    schema["type"] = Json::array({type, "string"});
    schema["pattern"] = computed;
  } else if (type.is_array() && schema.contains("pattern")) {
    schema["pattern"] = schema["pattern"].get<std::string>() + "|" + computed;
  } else if (schema.contains("enum") && schema["enum"].is_array()) {
    schema["anyOf"] =
        Json::array({{{"enum", schema["enum"]}}, {{"type", "string"}, {"pattern", computed}}});
    schema.erase("enum");
  }
}

}  // namespace

std::string json_schema(const Spec& spec, const std::string& title) {
  Json out = Json::object();
  out["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  out["title"] = title;
  Json schema = schema_of(spec);
  if (find_key(spec, "parameters")) accept_computed(schema);
  out.update(schema);
  return out.dump(2) + "\n";
}

std::string model_schema() { return json_schema(model_spec(), "Osculate model file"); }

}  // namespace osculate::deck
