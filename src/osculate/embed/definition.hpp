#pragma once
// Inside of the public library; included by its sources only.
#include "osculate/embed/values.hpp"
#include "osculate/options.hpp"

namespace osculate::embed {

/// The contact of a host as a pair of the kernel, prepared. Throws Refused.
template <int Dim>
[[nodiscard]] Definition<Dim> define(const Contact<Dim>& contact,
                                     std::span<const double> reference);

/// A number that is the same for contacts whose histories are of the same points and facets.
///
/// Formula    FNV-1a over the dimension, both surfaces, sampling, what decides which numbers a
///            history has, and the bits of the reference coordinates
template <int Dim>
[[nodiscard]] std::uint64_t key_of(const Contact<Dim>& contact, std::span<const double> reference);

}  // namespace osculate::embed
