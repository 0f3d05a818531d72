#include "osculate/embed/laws.hpp"

#include "osculate/contact/law/catalogue.hpp"

namespace osculate::embed {
namespace {

struct ToNormal {
  contact::NormalLaw operator()(const Penalty& l) const { return contact::penalty(l.stiffness); }
  contact::NormalLaw operator()(const Exponential& l) const {
    return contact::NormalExponential{l.pressure, l.clearance};
  }
  contact::NormalLaw operator()(const Table& l) const { return contact::NormalTable{l.points}; }
};

struct ToFriction {
  bool may_part;
  contact::FrictionLaw operator()(const Coulomb& l) const {
    contact::Coulomb law{l.mu, l.stiffness, l.cap};
    if (!l.change) return law;
    law.kinetic = l.change->kinetic;
    (l.change->by_speed ? law.speed : law.distance) = l.change->scale;
    return law;
  }
  contact::FrictionLaw operator()(const Tresca& l) const {
    return contact::Tresca{l.limit, l.stiffness};
  }
  contact::FrictionLaw operator()(const Rough& l) const {
    return may_part ? contact::Rough{l.stiffness, l.steep} : contact::Rough{l.stiffness};
  }
};

struct ToDamping {
  contact::DampingLaw operator()(const Viscous& l) const { return contact::Viscous{l.coefficient}; }
  contact::DampingLaw operator()(const Restitution& l) const {
    return contact::Restitution{l.value};
  }
};

}  // namespace

contact::NormalLaw law_of(const NormalLaw& law) { return std::visit(ToNormal{}, law); }
contact::FrictionLaw law_of(const FrictionLaw& law, bool may_part) {
  return std::visit(ToFriction{may_part}, law);
}
contact::DampingLaw law_of(const DampingLaw& law) { return std::visit(ToDamping{}, law); }

}  // namespace osculate::embed
