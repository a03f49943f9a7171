#include "tool/session_options.h"

#include <memory>

#include "tool/option_checks.h"
#include "tool/serve_command.h"
#include "tool/session_command.h"

namespace palpation::tool {
namespace {

constexpr double kFarthest_mm = 1e6;

struct Asked {
  SessionPlace place;
  SessionWords words;
  SessionExport where;
};

using Shared = std::shared_ptr<Asked>;  // lives as long as the command

CLI::App* action(CLI::App& session, const std::string& name, const std::string& what) {
  CLI::App* command = session.add_subcommand(name, what);
  command->fallthrough();
  return command;
}

void add_why(CLI::App& command, const Shared& asked) {
  command.add_option("--why", asked->words.why, "in a few words, for who reads the journal");
}

void add_place(CLI::App& command, const Shared& asked, const std::string& what) {
  command.add_option("--at-mm", asked->words.place_mm, what)
      ->expected(3)
      ->required()
      ->type_name("X Y Z")
      ->check(number(-kFarthest_mm, kFarthest_mm));
}

void add_loop(CLI::App& session, const Shared& asked) {
  action(session, "next", "The plan whose stops are open, or else the next one")->callback([asked] {
    session_next(asked->place);
  });

  CLI::App* record = action(session, "record", "Take readings: on the disk when it ends");
  record
      ->add_option("CSV", asked->words.readings,
                   "columns x,y,z,reading as for palpate plan, metres in the mesh's frame; index: "
                   "which stop a row answers; kind missed: it could not be touched")
      ->required();
  add_why(*record, asked);
  record->callback([asked] { session_record(asked->place, asked->words); });

  CLI::App* skip = action(session, "skip", "Stops that could not be touched: not planned again");
  skip->add_option("INDEX", asked->words.numbers, "of the plan; without: all that are open")
      ->check(whole(0, 1e6));
  add_why(*skip, asked);
  skip->callback([asked] { session_skip(asked->place, asked->words); });
}

void add_hand(CLI::App& session, const Shared& asked) {
  CLI::App* withdraw = action(session, "withdraw", "Take readings back");
  withdraw->add_option("NUMBER", asked->words.numbers, "of the readings, as show has them")
      ->required()
      ->check(whole(1, 1e9));
  add_why(*withdraw, asked);
  withdraw->callback([asked] { session_withdraw(asked->place, asked->words); });

  CLI::App* touch = action(session, "touch", "Go somewhere first in the next plan");
  add_place(*touch, asked, "a place on the tissue, in the mesh's frame");
  touch->callback([asked] { session_touch(asked->place, asked->words); });

  CLI::App* keep_out = action(session, "keep-out", "Plan no stop in a ball, from now on");
  add_place(*keep_out, asked, "its centre, in the mesh's frame");
  keep_out->add_option("--radius-mm", asked->words.radius_mm, "its radius")
      ->required()
      ->check(number(1e-6, kFarthest_mm));
  keep_out->callback([asked] { session_keep_out(asked->place, asked->words); });
}

void add_looks(CLI::App& session, const Shared& asked) {
  action(session, "show", "All that the journal says, whether or not another process writes it")
      ->callback([asked] { session_show(asked->place); });

  CLI::App* out = action(session, "export", "What palpate plan and boundary answer alike");
  out->add_option("--out", asked->where.folder, "folder for measurements.csv and scene.json")
      ->required();
  out->add_option("--plan", asked->where.plan, "as it was before this plan was made, from 0")
      ->check(whole(0, 1e6));
  out->add_flag("--overwrite", asked->where.overwrite, "replace other files of these names");
  out->callback([asked] { session_export(asked->place, asked->where); });
}

}  // namespace

void add_session_command(CLI::App& app) {
  const auto asked = std::make_shared<Asked>();
  CLI::App* session =
      app.add_subcommand("session", "A real run, step by step: nothing is lost, whoever is killed");
  session->add_option("SCENE", asked->place.scene, "the scene, a JSON file")->required();
  session->add_option("DIR", asked->place.folder, "the session's folder")->required();
  session
      ->add_option("--set", asked->place.overrides,
                   "override a value of the scene, the same each time; once for each value")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  session->add_flag("--anyway", asked->place.anyway,
                    "go on though scene, tissue or version changed and the plan with it");
  add_loop(*session, asked);
  add_hand(*session, asked);
  add_looks(*session, asked);
  session->callback([session, asked] {
    if (session->get_subcommands().empty()) session_show(asked->place);
  });
}

void add_serve_command(CLI::App& app) {
  const auto folder = std::make_shared<std::filesystem::path>();
  CLI::App* command = app.add_subcommand(
      "serve", "A session and the gate of its robot, as JSON lines: for callers in any language");
  command->add_option("DIR", *folder, "the session's folder, where open does not name one");
  command->callback([folder] { serve(*folder); });
}

}  // namespace palpation::tool
