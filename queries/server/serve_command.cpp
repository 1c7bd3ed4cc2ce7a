#include "queries/server/serve_command.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>

#include "queries/server/server.h"

namespace queries {

CLI::App* add_serve_command(CLI::App& app, ServerOptions& options) {
  CLI::App* serve = app.add_subcommand("serve", "Serve a database over HTTP, with a viewer for the browser");
  serve->add_option("--db", options.database, "Database file")->type_name("FILE")->required();
  CLI::Option* const create = serve->add_flag("--create", options.creates, "Make the database if there is none");
  serve->add_option("--port", options.port, "TCP port; 0: any free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  serve->add_option("--listen", options.listen, "Address to listen on; others than this machine's own need a token")
      ->type_name("ADDR")
      ->capture_default_str();
  serve->add_flag("--read-only", options.read_only, "Change nothing: neither the database nor files")->excludes(create);
  serve
      ->add_option("--token-file", options.token_file,
                   "File with the token that every request must give (default: $ALGEBRA3D_TOKEN, if it is set)")
      ->type_name("FILE");
  serve
      ->add_option("--host", options.hosts,
                   "Further name of this server in addresses, such as that of a proxy before it, with https:// if the "
                   "proxy speaks it; may be repeated")
      ->type_name("[SCHEME://]NAME[:PORT]")
      ->allow_extra_args(false);
  serve
      ->add_option("--embed", options.embedders,
                   "Origin whose pages may show the viewer in a frame (default: none); may be repeated")
      ->type_name("SCHEME://NAME[:PORT]")
      ->allow_extra_args(false);
  serve->add_option("--max-upload", options.max_upload_megabytes, "Largest file that can be sent, in megabytes")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  serve->add_option("--max-seconds", options.max_seconds, "Longest time of a statement; 0: no limit")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  serve
      ->add_option("--memory", options.memory_megabytes,
                   "Memory limit of all sessions, kept results and answers together, in megabytes (default: three "
                   "quarters of what the machine or its control group has)")
      ->check(CLI::Range(1, 1 << 30));
  serve
      ->add_option("--failure-folder", options.failure_folder,
                   "Folder for reports of internal errors (default: that of temporary files)")
      ->type_name("DIR");
  serve->footer(
      "Open the printed address in a browser. Programs find the HTTP API at /api/openapi.json (docs/http-api.md).\n"
      "Statements read files in the working folder only, except hidden ones, and write new files there: no file is\n"
      "replaced. Ctrl-C ends the server; the database stays intact.\n"
      "Exit status: 0 ended by Ctrl-C or SIGTERM, 1 the database could not be opened or the port is taken, 2 wrong "
      "usage.");
  return serve;
}

int run_serve(const ServerOptions& options, const algebra3d::Registry& registry, const std::atomic<bool>& stop) {
  // A terminal that was closed does not end the server.
  std::signal(SIGPIPE, SIG_IGN);
  const auto ready = [&](const std::string& url) {
    std::cout << "Serving " << options.database.string() << (options.read_only ? " (read-only)" : "") << " at\n\n    "
              << url << "\n\nOpen this address in a browser. Ctrl-C ends the server." << std::endl;
  };
  const auto note = [](const std::string& text) { std::cerr << "note: " << text << "\n"; };
  const algebra3d::Status status = serve(options, registry, stop, ready, note);
  if (status) return 0;
  std::cerr << "error: " << status.error().text() << "\n";
  return status.error().code == algebra3d::ErrorCode::wrong_usage ? 2 : 1;
}

}  // namespace queries
