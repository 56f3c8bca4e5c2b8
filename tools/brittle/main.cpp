// brittle: shatters models and simulates scenes from the command line. Every subcommand stands in a file of its own; a new one
// is a row below.
#include "modules/brittle/register_module.h"
#include "tools/brittle/command.h"
#include "tools/brittle/driver_threads.h"
#include "tools/brittle/interrupt.h"
#include "tools/brittle/unknown_word.h"

#include <cstdio>
#include <fcntl.h>
#include <span>
#include <unistd.h>

namespace {

constexpr cli::AddCommand kCommands[] = {cli::addShatter,  cli::addDevices, cli::addDoctor,     cli::addScenes,
                                         cli::addSimulate, cli::addPlan,    cli::addCompare,    cli::addAccuracy,
                                         cli::addHard,     cli::addBench,   cli::addCheckDevice};

constexpr const char* kFooter =
    "Examples:\n"
    "  brittle shatter vase.obj -o pieces.glb\n"
    "  brittle shatter builtin:ring -o ring.glb --sites 40 --picture ring.png --explode 0.3\n"
    "  brittle doctor vase.obj\n"
    "  brittle simulate card_house -o house.glb\n"
    "  brittle plan card_house --measure\n"
    "  brittle accuracy --quick -o out/accuracy\n"
    "\n"
    "Exit codes: 0 done, 2 bad usage or input, 3 too large for a pool, 4 no device, 1 a bug of ours.";

// CLI11 explains usage errors over several lines; one is enough. It says the least about words that it does not know.
int badUsage(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> words) {
    const std::string unknown = cli::aboutUnknownWord(app, words);
    const std::string message = unknown.empty() ? std::string(error.what()) + "; see brittle --help" : unknown;
    return cli::fail({engine::ErrorCode::BadInput, message});
}

// Where standard streams are closed, the first files that are opened would take their numbers, and what is printed would go
// there. Opened the wrong way round, they fail as closed ones do.
void occupyClosedStreams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) == -1) (void)open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

} // namespace

int main(int argc, char** argv) {
    occupyClosedStreams();
    cli::spreadDriverThreads();
    cli::cleanUpWhenInterrupted();
    CLI::App app{"Shatters closed meshes into closed fragments, on the GPU.", "brittle"};
    app.require_subcommand(1);
    app.set_version_flag("--version", "brittle " + brittle::makeBrittleModule()->info().version);
    app.footer(kFooter);
    int exit_code = cli::kOk;
    for (const cli::AddCommand add : kCommands)
        add(app, exit_code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) return badUsage(app, error, {argv + 1, argv + argc});
        app.exit(error); // prints help or the version
    } catch (const std::exception& error) {
        return cli::fail({engine::ErrorCode::Internal, error.what()});
    }
    const auto printed = cli::checkPrinted();
    return printed || exit_code != cli::kOk ? exit_code : cli::fail(printed.error());
}
