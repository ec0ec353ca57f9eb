#!/bin/sh
# Stands for a program that crashes whatever it is given.
kill -SEGV $$
