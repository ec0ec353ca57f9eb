"""python -m fencepost: the program."""
from ._program import main

main()
