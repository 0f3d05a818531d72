// Results in the files of CalculiX: keys frd and dat of `output`.
#include "osculate/core/text.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

using R = AnswerRequest;

BoundKey<R> results_key(std::vector<Choice> words, const std::string& example) {
  return {
      required("of",
               list("Results.", choice("A result.", std::move(words))).count(1).such_as(example)),
      [](R& r, const Value& v) {
        for (const Value& item : v.items) r.of.push_back(static_cast<Answer>(item.code));
      }};
}

BoundKey<R> every_key() {
  return may(
      &R::every, "every",
      integer("Every n-th increment of a step, and its last one.").at_least(1).otherwise("1"));
}

BoundKey<R> steps_of_key() {
  return may(&R::steps, "steps",
             list("In these steps.", text("Name of a step.").such_as("press"))
                 .count(1)
                 .otherwise_as("all")
                 .such_as("[press, shear]"));
}

BoundKeys<R> frd_keys() {
  using A = Answer;
  return {
      {results_key(
           {word("U", A::u, "displacement (DISP)"), word("S", A::s, "stress (STRESS)"),
            word("E", A::e, "strain (TOSTRAIN)"),
            word("RF", A::rf, "forces: loads and reactions (FORC)"),
            word("PEEQ", A::peeq, "equivalent plastic strain (PE)"),
            word("ENER", A::ener, "work per volume, stored and dissipated in the material (ENER)"),
            word("CONTACT", A::contact,
                 "gap, slip, pressure and shear at the slaves' nodes (CONTACT)"),
            word("CELS", A::cels, "energies of the springs of the penalties there (CELS)")},
           "[U, S, RF]"),
       every_key(), steps_of_key()}};
}

BoundKeys<R> dat_keys() {
  using A = Answer;
  return {
      {may(&R::on, "on",
           text("Set of nodes (U, RF), of cells or (SOF) of facets; without it of everything.")
               .such_as("top")),
       results_key(
           {word("U", A::u, "displacements of nodes"),
            word("RF", A::rf, "forces at nodes: loads and reactions"),
            word("S", A::s, "stresses at the quadrature points of cells"),
            word("E", A::e, "strains there"),
            word("PEEQ", A::peeq, "equivalent plastic strain there"),
            word("ENER", A::ener, "work per volume there: stored and dissipated in the material"),
            word("EVOL", A::evol, "volumes of cells"),
            word("ELSE", A::energy, "work on cells: stored and dissipated in the material"),
            word("SOF", A::sof,
                 "force and moment that act on a body through facets of its cells, on its "
                 "boundary or inside, with their centre, mean normal and area"),
            word("CDIS", A::cdis, "gap and slip of slave nodes in contact, of all pairs"),
            word("CSTR", A::cstr, "pressure and shear there"),
            word("CELS", A::cels, "energies of the springs of the penalties there"),
            word("CNUM", A::cnum, "how many slave nodes are in contact")},
           "[U, RF]"),
       may(&R::totals, "totals",
           choice("Sums over the set (RF, EVOL, ELSE), of CELS over all contacts.",
                  {word("none", Totals::none, "no"), word("also", Totals::also, "with the values"),
                   word("only", Totals::only, "without the values")})
               .otherwise("none")),
       may(&R::local, "local",
           boolean("U and RF of nodes with `axes` are along these, in rows that end in L, as "
                   "CalculiX has them without GLOBAL=YES. Sums are along x, y and z.")
               .otherwise("false")
               .such_as("true")),
       every_key(), steps_of_key()}};
}

}  // namespace

BoundKey<Output> frd_key() {
  return {optional("frd", list("Results at the nodes in MODEL.frd, which the tools around CalculiX "
                               "read.",
                               frd_keys().spec("Results, and when."))
                              .otherwise("[]")
                              .such_as("[{of: [U, S, RF, CONTACT]}]")),
          [](Output& o, const Value& v) { o.frd = frd_keys().read_all(v); }};
}

BoundKey<Output> dat_key() {
  return {optional("dat", list("Tables in MODEL.dat, laid out as CalculiX does.",
                               dat_keys().spec("Results of a set, and when."))
                              .otherwise("[]")
                              .such_as("[{on: top, of: [RF], totals: only}]")),
          [](Output& o, const Value& v) { o.dat = dat_keys().read_all(v); }};
}

void check_answers(const Description& description) {
  std::vector<std::string> names;
  for (const Step& step : description.steps) names.push_back(step.name.value);
  for (const R& request : description.output.dat)
    if (request.on.empty() && std::ranges::find(request.of, Answer::sof) != request.of.end())
      throw core::InputError(request.mark, "SOF needs a set of facets: on");
  if (description.output.as_given)
    for (const R& request : description.output.frd)
      if (std::ranges::find(request.of, Answer::contact) != request.of.end() ||
          std::ranges::find(request.of, Answer::cels) != request.of.end())
        throw core::InputError(request.mark,
                               "CONTACT and CELS are of the solids that shells become: not with "
                               "shells_as_given");
  for (const std::vector<R>* const list : {&description.output.frd, &description.output.dat})
    for (const R& request : *list)
      for (const Name& step : request.steps)
        if (std::ranges::find(names, step.value) == names.end())
          throw core::InputError(step.mark,
                                 core::unknown_name_message("step", printable(step.value), names));
}

}  // namespace osculate::deck
