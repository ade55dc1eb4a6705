"""`gearlink` and `python -m gearlink` begin here; nothing else imports this module.

Ctrl-C is heard before anything large is loaded.
"""

from gearlink.cli.process import end_at_interrupt

end_at_interrupt()

from gearlink.cli.main import main  # noqa: E402

if __name__ == "__main__":
    main()
