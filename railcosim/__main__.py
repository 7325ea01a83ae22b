"""`python -m railcosim` is the command `railcosim`."""

import signal


def main() -> None:
    """Run the command; Ctrl-C while its modules are loaded ends it at once, without a traceback."""
    handler = signal.getsignal(signal.SIGINT)
    if handler is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from .cli import main as run  # noqa: PLC0415  # takes a good part of a second

    signal.signal(signal.SIGINT, handler)
    run()


if __name__ == "__main__":
    main()
