"""Several processes do what one does: the same iterations, states of contact points and histories."""
import json
import os
from concurrent.futures import ThreadPoolExecutor

from models import FILES, MODELS, SAME_BITS, TOLERANCES
from ranks_case import SOURCE, RanksCase, main


class Alike(RanksCase):
    tolerance = 1e-10  # seen: 1e-11 in the augmented one, whose iterations end where a tolerance is met; 3e-13 elsewhere

    def compare(self, number, name, model):
        """Three processes and one, and in turn two or eight. Factors are shared by three, and by eight in every second model."""
        of = {n: f"{number}.{n}" for n in (1, 3, (2, 8)[number % 2])}
        for processes, out in of.items():
            self.run_program(processes, "run", model, "-o", out, share_from="0" if processes == 3 or number % 4 == 1 else "1e9")
            self.assertEqual(self.counts(out), self.counts(of[1]), f"{name}, {processes} processes")
            self.assertEqual(self.summary(out)["message"], self.summary(of[1])["message"])
        several = [out for n, out in of.items() if n > 1]
        for out, reference in ((several[0], of[1]), (several[1], of[1]), (several[0], several[1])):
            worst, column = self.difference(out, reference)
            self.assertLess(worst, TOLERANCES.get(name, self.tolerance), f"{name}: {column} of {out} and {reference}")
            if name in SAME_BITS:
                self.assertEqual(worst, 0, f"{name}: {column} of {out} and {reference}")

    def test_models(self):
        jobs = []
        for number, (name, text) in enumerate(MODELS.items()):
            self.write(text, f"model{number}.yaml")
            jobs.append((number, name, f"model{number}.yaml"))
        jobs += [(len(MODELS) + i, name, os.path.join(SOURCE, file)) for i, (name, file) in enumerate(FILES.items())]
        with ThreadPoolExecutor(2) as pool:
            for job, done in [(job, pool.submit(self.compare, *job)) for job in jobs]:
                with self.subTest(model=job[1]):
                    done.result()

    def test_says_how_evenly_processes_have_worked(self):
        self.write(next(iter(MODELS.values())))
        for processes in (1, 3):
            self.run_program(processes, "run", "model.yaml", "-o", str(processes))
        summaries, logs = [], []
        for out in ("1", "3"):
            with open(self.path(out, "summary.json")) as summary, open(self.path(out, "log.txt")) as log:
                summaries.append(json.load(summary))
                logs.append(log.read())
        self.assertNotIn("processes", summaries[0])
        self.assertNotIn("processes:", logs[0])
        found = summaries[1]["processes"]
        working = found["working"]
        self.assertEqual((len(working), len(found["peak_memory_mb"])), (3, 3))
        self.assertEqual(found["slowest"], working.index(max(working)))
        self.assertAlmostEqual(found["imbalance"], 3 * max(working) / sum(working), 6)
        for seconds, memory in zip(working, found["peak_memory_mb"]):
            self.assertTrue(0 < seconds < summaries[1]["seconds"]["total"] + 0.1, seconds)
            self.assertGreater(memory, 1)
        self.assertRegex(logs[1], rf"processes: 3, at work for .* the slowest \({found['slowest']}\)")

    def modes(self, out):
        steps = self.summary(out)["steps"]
        return [[mode["omega_squared"] for mode in steps[1]["modes"]["found"]], steps[2]["buckling"]["factors"]]

    def test_modes(self):
        """Vibrations and buckling after increments that were shared: each process looks for all."""
        self.write(MODELS["modes"])
        for processes in (1, 2):
            self.run_program(processes, "run", "model.yaml", "-o", str(processes))
        modes = [self.modes(out) for out in ("1", "2")]
        self.assertEqual([len(m) for m in modes[0]], [3, 2])
        for one, two in zip(*modes):
            for a, b in zip(one, two):
                self.assertLess(abs(a / b - 1), 1e-8)


if __name__ == "__main__":
    main()
