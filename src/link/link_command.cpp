#include "link/link_command.h"

#include <cstdio>
#include <memory>

#include "link/live_session.h"
#include "link/messages.h"
#include "scene/interrupt.h"
#include "scene/patient_frame.h"
#include "scene/words.h"

namespace palpation::link {
namespace {

/// Between two looks at the session.
constexpr std::chrono::milliseconds kRound{100};
constexpr int kMostPort = 65535;
constexpr double kMostPatience_s = 3600.0;

void say(std::FILE* where, const std::string& words) {
  std::fprintf(where, "%s\n", words.c_str());
  std::fflush(where);
}

/// A client's coming and going is said; what is odd about one is a warning.
Listener listener_of(const LinkedSession& session) {
  return [quiet = session.quiet](Said said, const std::string& words) {
    if (said == Said::Dropped || said == Said::Odd)
      say(stderr, "palpate: warning: link: " + words);
    else if (!quiet)
      say(stdout, words);
  };
}

void serve_until_interrupted(LiveSession& live, LinkServer& server) {
  try {
    for (;;) {
      tool::check_interrupt();
      if (const std::string words = live.look(server); !words.empty())
        say(stderr, "palpate: warning: link: " + words);
      server.serve(kRound);
    }
  } catch (const tool::Interrupted&) {
    server.show(
        {"palpate", "STATUS", status_message("palpate", Status::ShutDown, "palpate link ends")});
    server.serve(std::chrono::milliseconds(0));
    throw;
  }
}

}  // namespace

void link_session(const LinkedSession& session, const ServerOptions& options) {
  require_openigtlink();
  const tool::Scene scene = tool::Scene::read(session.scene, session.overrides);
  const tool::Tissue tissue = tool::tissue_of(scene);
  tool::tell(tissue.warnings);
  const Frame frame = tool::frame_asked(session.frame, tissue.frame, session.scene.string());
  tool::require_patients_frame(frame, "link");
  LiveSession live(session.folder, scene, tissue, frame);
  LinkServer server(options, listener_of(session));
  if (!session.quiet)
    say(stdout, "Showing " + session.folder.string() + " at " + server.address() +
                    ", in millimetres, RAS" + (frame == Frame::Lps ? " (turned from LPS)" : "") +
                    ". In 3D Slicer: OpenIGTLinkIF, a connector, client, that host and port, "
                    "active. Ctrl-C ends it.");
  serve_until_interrupted(live, server);
}

namespace {

struct Asked {
  LinkedSession session;
  ServerOptions server;
};

void add_place(CLI::App& command, const std::shared_ptr<Asked>& asked) {
  command.add_option("--port", asked->server.port, "where clients connect; 0: any that is free")
      ->check(CLI::Range(0, kMostPort));
  command
      .add_option("--host", asked->server.host,
                  "the address of this machine that is listened at: 127.0.0.1 for programs on it, "
                  "0.0.0.0 for everybody who reaches it: nobody is asked who they are")
      ->check([](const std::string& name) { return name.empty() ? "is empty" : ""; });
  command
      .add_option("--patience-s", asked->server.patience_s,
                  "a client that takes nothing for so long is dropped")
      ->check([](const std::string& text) {
        double value = 0.0;
        const bool is_one = CLI::detail::lexical_cast(text, value);
        return is_one && value >= 0.1 && value <= kMostPatience_s ? ""
                                                                  : "must be from 0.1 to 3600 s";
      });
}

}  // namespace

void add_link_command(CLI::App& app) {
  const auto asked = std::make_shared<Asked>();
  CLI::App* command = app.add_subcommand(
      "link", "A session, live, for 3D Slicer: an OpenIGTLink server that only reads it");
  command->add_option("SCENE", asked->session.scene, "the scene, a JSON file")->required();
  command
      ->add_option("DIR", asked->session.folder,
                   "the session's folder; another process may write it meanwhile")
      ->required();
  add_place(*command, asked);
  command
      ->add_option("--frame", asked->session.frame,
                   "whose frame the coordinates are in, where neither the scene (surface.frame) "
                   "nor the mesh's file says; LPS is turned to RAS, which OpenIGTLink wants")
      ->check(CLI::IsMember({"RAS", "LPS"}));
  command
      ->add_option("--set", asked->session.overrides,
                   "override a value of the scene, as the session does; once for each value")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  command->add_flag("--quiet", asked->session.quiet, "print only warnings and errors");
  command->callback([asked] { link_session(asked->session, asked->server); });
}

}  // namespace palpation::link
