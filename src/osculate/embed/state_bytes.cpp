#include "osculate/embed/state_bytes.hpp"

#include <fmt/format.h>

#include <cstring>

#include "osculate/version.hpp"

namespace osculate::embed {
namespace {

/// Of all bytes, in this order.
struct Head {
  std::array<char, 4> name{'O', 'S', 'C', 'U'};
  std::uint32_t format = state_format;
  Kind kind = Kind::history;
  std::uint8_t dimension = 0;
  std::uint64_t key = 0;
};
template <class Archive>
void fields(Archive& a, Head& h) {
  a(h.name, h.format, h.kind, h.dimension, h.key);
}
constexpr std::size_t head_size = 18, tail_size = 8;

const char* name_of(Kind kind) {
  return kind == Kind::history      ? "history"
         : kind == Kind::active_set ? "active set"
                                    : "multipliers";
}

}  // namespace

std::uint64_t fingerprint(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ull;
  return hash;
}

std::vector<std::byte> packed(Kind kind, int dimension, std::uint64_t key,
                              const std::string& values) {
  core::Saver head, tail;
  head(Head{.kind = kind, .dimension = static_cast<std::uint8_t>(dimension), .key = key});
  const std::string body = head.take() + values;
  tail(fingerprint(body));
  const std::string all = body + tail.take();
  std::vector<std::byte> out(all.size());
  std::memcpy(out.data(), all.data(), all.size());
  return out;
}

std::string unpacked(Kind kind, int dimension, std::uint64_t key,
                     std::span<const std::byte> bytes) {
  const std::string name = name_of(kind);
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Head head;
  if (all.size() < head_size + tail_size) throw Refused(name + ": these bytes are too few");
  core::Loader(all.substr(0, head_size))(head);
  if (head.name != Head{}.name) throw Refused(name + ": these are no bytes of this library");
  if (head.format != state_format)
    throw Refused(fmt::format("{}: the bytes have the format {}, and this library reads {}", name,
                              head.format, state_format));
  if (head.kind != kind)
    throw Refused(
        fmt::format("{}: the bytes are those of another value ({})", name, name_of(head.kind)));
  std::uint64_t expected = 0;
  const std::string_view body = all.substr(0, all.size() - tail_size);
  core::Loader(all.substr(body.size()))(expected);
  if (fingerprint(body) != expected) throw Refused(name + ": the bytes are damaged");
  if (head.dimension != dimension || head.key != key)
    throw Refused(name + ": it belongs to another contact");
  return std::string(body.substr(head_size));
}

}  // namespace osculate::embed
