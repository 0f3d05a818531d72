#include "osculate/io/report.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "osculate/core/error.hpp"
#include "osculate/io/markup.hpp"
#include "osculate/io/report_bundle.hpp"

namespace osculate::io {
namespace {

using Json = nlohmann::json;

/// Walks the data once without storing it: is it JSON, is it an object, and what is its title.
class TitleReader : public nlohmann::json_sax<Json> {
 public:
  std::string title;
  std::string problem;
  std::size_t position = 0;

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool string(string_t& text) override {
    if (depth_ == 1 && at_title_) title = text;
    return value();
  }
  bool key(string_t& name) override {
    at_title_ = depth_ == 1 && name == "title";
    return true;
  }
  bool start_object(std::size_t) override { return open(); }
  bool start_array(std::size_t) override { return value() && open(); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t byte, const std::string&,
                   const nlohmann::detail::exception& error) override {
    position = byte;
    problem = error.what();
    return false;
  }

 private:
  /// A value at depth 0 is not an object: refuse it.
  bool value() {
    if (depth_ == 0) problem = "the report data must be one JSON object";
    return depth_ > 0;
  }
  bool open() {
    ++depth_;
    at_title_ = false;
    return true;
  }
  bool close() {
    --depth_;
    return true;
  }

  int depth_ = 0;
  bool at_title_ = false;
};

std::string read_title(const std::string& data) {
  TitleReader reader;
  if (!Json::sax_parse(data, &reader)) {
    const auto end =
        data.begin() + static_cast<std::ptrdiff_t>(std::min(reader.position, data.size()));
    const int line = 1 + static_cast<int>(std::count(data.begin(), end, '\n'));
    throw core::InputError({"report.json", line, ""}, reader.problem);
  }
  return reader.title;
}

/// `<` occurs only inside strings of JSON, where \u003c means the same: neither `</script>` nor
/// `<!--` can then end the data early.
std::string escape_data(std::string_view json) {
  std::string out;
  out.reserve(json.size() + json.size() / 64);
  for (std::size_t at = 0; at < json.size();) {
    const std::size_t next = std::min(json.find('<', at), json.size());
    out.append(json, at, next - at);
    if (next < json.size()) out += "\\u003c";
    at = next + 1;
  }
  return out;
}

struct Place {
  std::string_view mark, text;
};

/// Replaces each mark once, where the template has it: a text that is put in is not searched.
std::string fill(std::string_view page, std::span<const Place> places) {
  std::string out;
  while (!page.empty()) {
    std::size_t first = page.size();
    const Place* next = nullptr;
    for (const Place& place : places) {
      const std::size_t at = page.find(place.mark);
      if (at < first) {
        first = at;
        next = &place;
      }
    }
    out.append(page.substr(0, first));
    if (next == nullptr) break;
    out.append(next->text);
    page.remove_prefix(first + next->mark.size());
  }
  return out;
}

/// `asks`: whom the page may ask for data, as its policy says it.
std::string page(const std::string& data_json, const std::string& title_text,
                 std::string_view asks) {
  std::string title = escape_markup(title_text);
  if (title.empty()) title = "Osculate";
  const std::string data = escape_data(data_json);
  const std::array<Place, 4> places{
      {{"@TITLE@", title}, {"@DATA@", data}, {"@BUNDLE@", report_bundle()}, {"@CONNECT@", asks}}};
  return fill(report_template(), places);
}

}  // namespace

std::string report_html(const std::string& data_json) {
  return report_html(data_json, read_title(data_json));
}

std::string report_html(const std::string& data_json, const std::string& title_text) {
  return page(data_json, title_text, "'none'");
}

std::string live_html(const std::string& title) {
  return page(R"({"live":true})", title, "'self'");
}

std::string base64_f32(std::span<const float> values) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  bytes.reserve(values.size() * 4);
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int shift = 0; shift < 32; shift += 8)
      bytes.push_back(static_cast<std::uint8_t>(bits >> shift & 0xffU));
  }
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < left ? bytes[i + k] : std::uint32_t{0});
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= left ? letters[group >> (18 - 6 * k) & 63U] : '=';
  }
  return out;
}

}  // namespace osculate::io
