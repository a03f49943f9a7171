#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <string>
#include <utility>

#include "palpation/base/error.h"
#include "palpation/io/measurements.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/exclusive.h"
#include "python/long_call.h"
#include "python/open_session.h"
#include "python/told_rows.h"
#include "python/warn.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

struct Handle {
  std::filesystem::path folder;
  std::unique_ptr<OpenSession> open;  ///< nothing once it is closed
};

using SharedSession = Exclusive<Handle>;
using SessionClass = py::class_<SharedSession>;
constexpr const char* kSession = "Session";

OpenSession& opened(Handle& handle) {
  require(handle.open != nullptr, kSession, handle.folder.string(),
          "is closed: open it again by Session(scene, folder)");
  return *handle.open;
}

/// What a session answers. One that could not write is closed: only opening it again tells what its
/// journal holds.
template <typename Ask>
auto answer(Handle& handle, const Ask& question) {
  OpenSession& session = opened(handle);
  try {
    return long_call([&] { return question(session); });
  } catch (const WriteError&) {
    handle.open.reset();
    throw;
  }
}

template <typename Ask>
auto answer(SharedSession& shared, const Ask& question) {
  const auto handle = shared.take(kSession);
  return answer(*handle, question);
}

/// A person's hand or a robot's word: on the disk when it returns.
template <typename Act>
void act(SharedSession& shared, const Act& act) {
  answer(shared, [&](OpenSession& session) {
    act(session.session());
    session.session().sync();
    return true;
  });
}

SceneAsked scene_asked(const py::object& scene, std::vector<std::string> overrides) {
  if (!py::isinstance<py::dict>(scene))
    return {.path = py::module_::import("os").attr("fspath")(scene).cast<std::filesystem::path>(),
            .overrides = std::move(overrides)};
  const py::object text = py::module_::import("json").attr("dumps")(scene);
  return {.text = text.cast<std::string>(), .overrides = std::move(overrides)};
}

std::unique_ptr<SharedSession> session_on(const py::object& scene,
                                          const std::filesystem::path& folder,
                                          std::vector<std::string> overrides, bool anyway) {
  const SceneAsked asked = scene_asked(scene, std::move(overrides));
  auto open = long_call([&] { return std::make_unique<OpenSession>(asked, folder, anyway); });
  warn(open->remarks());
  return std::make_unique<SharedSession>(Handle{folder, std::move(open)});
}

py::list answers_of(const std::vector<Recorded>& recorded) {
  py::list answers;
  for (const Recorded& one : recorded)
    answers.append(py::dict("number"_a = one.number, "new"_a = one.is_new, "stop"_a = one.stop,
                            "off_tissue"_a = one.off_tissue));
  return answers;
}

py::list record(SharedSession& shared, const py::object& readings, const py::object& where,
                const py::object& stop, const py::object& noise_variance, const py::object& travel,
                const py::object& t, const std::string& kind, const std::string& why) {
  const auto handle = shared.take(kSession);
  const OpenSession& session = opened(*handle);
  std::vector<Told> told;
  if (py::isinstance<Readings>(readings)) {
    require(where.is_none() && stop.is_none() && noise_variance.is_none() && travel.is_none(),
            "Session.record", "where, stop, noise_variance and travel",
            "are part of Readings: leave them out");
    told = told_rows(session.surface(), readings.cast<const Readings&>(), t);
  } else {
    told = told_rows(session.surface(), session.state(),
                     {where, stop, {readings, noise_variance, travel}, t, kind, why});
  }
  return answers_of(answer(*handle, [&](OpenSession& open) { return open.record(told); }));
}

void miss(SharedSession& shared, const py::object& stop, const std::string& why) {
  const auto handle = shared.take(kSession);
  const SessionState& state = opened(*handle).state();
  const int count = state.plans.empty() ? 0 : static_cast<int>(state.plans.back().stops.size());
  const std::vector<int> stops =
      stop.is_none() ? state.open_stops() : stop_numbers(stop, {"Session.miss", "stop"}, count);
  std::vector<Told> told;
  for (const int one : stops) told.push_back({{.kind = TouchKind::Missed, .stop = one}, why});
  answer(*handle, [&](OpenSession& open) { return open.record(told); });
}

py::list journal(const std::filesystem::path& folder) {
  const py::object loads = py::module_::import("json").attr("loads");
  py::list entries;
  for (const std::string& line : long_call([&] { return journal_lines(folder); }))
    entries.append(loads(line));
  return entries;
}

void bind_loop(SessionClass& session) {
  session
      .def(
          "next",
          [](SharedSession& shared) {
            return answer(shared, [](OpenSession& open) { return open.session().next(); });
          },
          "The plan whose stops are open; once something has become of all of them, the next one, "
          "which is on the disk before it is returned. Empty: finished.")
      .def("record", &record, "readings"_a, "where"_a = py::none(), py::kw_only(),
           "stop"_a = py::none(), "noise_variance"_a = py::none(), "travel"_a = py::none(),
           "t"_a = py::none(), "kind"_a = "stop", "why"_a = "",
           "Takes what was felt, all or, when it raises, nothing; on the disk when it returns. "
           "readings: Readings, or n numbers: of the open stops in their order; of the stops that "
           "`stop` names; or made at `where` (n vertices, or n x 3 positions in metres), each of "
           "the nearest open stop within a millimetre, if there is one. NaN: the stop could not be "
           "touched, `why` in words. noise_variance: a number or n, NaN is the field's noise. "
           "travel: n x 3 directions. t: seconds, a number or n. kind: 'stop' or 'way'. Returns "
           "for each 'number' (of its row, from 1), 'new' (False: it had been told before), 'stop' "
           "(that it answers, or None) and 'off_tissue' (why it will not be used, or empty).")
      .def("miss", &miss, "stop"_a = py::none(), "why"_a = "",
           "Stops could not be touched: a number, several, or None for all that are open. They are "
           "not planned again.")
      .def(
          "withdraw",
          [](SharedSession& shared, int number, const std::string& why) {
            act(shared, [&](Session& here) { here.withdraw(number, why); });
          },
          "number"_a, "why"_a = "", "Takes the reading of a row back.")
      .def(
          "touch_first",
          [](SharedSession& shared, const py::object& place) {
            const Vec3 there = vector_of(place, {"Session.touch_first", "place"});
            act(shared, [&](Session& here) { here.touch_first(there); });
          },
          "place"_a, "The next plan goes there first: (x, y, z) on the tissue, metres.")
      .def(
          "keep_out",
          [](SharedSession& shared, const py::object& centre, double radius_m) {
            const Vec3 middle = vector_of(centre, {"Session.keep_out", "centre"});
            act(shared, [&](Session& here) { here.keep_out({middle, radius_m}); });
          },
          "centre"_a, "radius_m"_a,
          "No stop is planned in that ball from now on; open stops in it are missed.")
      .def(
          "note_refusal",
          [](SharedSession& shared, const std::string& words) {
            act(shared, [&](Session& here) { here.note_refusal(words); });
          },
          "words"_a, "What was refused, such as a motion, for who reads the journal.");
}

void bind_looks(SessionClass& session) {
  session
      .def(
          "conclude",
          [](SharedSession& shared) {
            return answer(shared, [](OpenSession& open) { return open.conclude(); });
          },
          "All that follows from what the session holds, as `palpate boundary` concludes of its "
          "export.")
      .def(
          "measurements_csv",
          [](SharedSession& shared) {
            return answer(shared, [](OpenSession& open) { return measurements_csv(open.state()); });
          },
          "The text of the measurements.csv that its export writes.")
      .def_property_readonly(
          "surface", [](SharedSession& shared) { return opened(*shared.take(kSession)).surface(); },
          "The tissue of its scene.")
      .def_property_readonly(
          "remarks",
          [](SharedSession& shared) {
            return py::tuple(py::cast(opened(*shared.take(kSession)).remarks()));
          },
          "Sentences: what is odd about scene and tissue, what changed since, what a death left. "
          "They were UserWarnings when it was opened.")
      .def_property_readonly(
          "open_stops",
          [](SharedSession& shared) {
            return array_of(opened(*shared.take(kSession)).state().open_stops());
          },
          "Of the last plan, those that nothing has become of yet.")
      .def_property_readonly("folder",
                             [](SharedSession& shared) { return shared.take(kSession)->folder; })
      .def_property_readonly(
          "journal", [](SharedSession& shared) { return journal(shared.take(kSession)->folder); },
          "Its lines, a dict each. Session.read_journal reads that of any folder.")
      .def_static("read_journal", &journal, "folder"_a,
                  "The lines of a session's journal, a dict each, whether or not somebody writes "
                  "it. Raises IoError, with the line, where one is corrupted.");
}

void bind_closing(SessionClass& session) {
  const auto close = [](SharedSession& shared) {
    const auto handle = shared.take(kSession);
    const std::unique_ptr<OpenSession> closing = std::move(handle->open);
    if (closing == nullptr) return;
    long_call([&] {
      closing->session().sync();
      return true;
    });
  };
  session.def("close", close, "Another process may open the folder then. Again: nothing.")
      .def_property_readonly(
          "closed", [](SharedSession& shared) { return shared.take(kSession)->open == nullptr; })
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [close](SharedSession& shared, const py::args&) { close(shared); })
      .def("__repr__", [](SharedSession& shared) {
        const auto handle = shared.take(kSession);
        return "<palpation.Session: " + handle->folder.string() + (handle->open ? "" : ", closed") +
               ">";
      });
}

}  // namespace

void bind_session(py::module_& module) {
  bind_session_plan(module);
  SessionClass session(
      module, "Session",
      "A real run, step by step, whose every word is on the disk before it is acted on: `palpate "
      "session` from Python, on the same folders, with the same answers.\n\n"
      "    with Session(\"scene.json\", \"run7\") as session:\n"
      "        while plan := session.next():\n"
      "            session.record(touch(plan.positions[plan.open]))");
  session.def(py::init(&session_on), "scene"_a, "folder"_a, py::kw_only(),
              "overrides"_a = std::vector<std::string>(), "anyway"_a = false,
              "Opens the folder, or makes it. scene: a file, or a dict of its keys; overrides: "
              "\"KEY=VALUE\" each. One writer at a time: raises WriteError while another has it "
              "open, IoError where scene, tissue or program changed and the last plan with it "
              "(anyway: goes on with a new plan).");
  bind_loop(session);
  bind_looks(session);
  bind_closing(session);
}

}  // namespace palpation::python
