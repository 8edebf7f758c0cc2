"""`python -m crazing` is the command `crazing`."""

from crazing.cli import main

if __name__ == "__main__":
    main(prog_name="crazing")
