import { defineConfig } from 'vite';

// Nothing is inlined: the server's Content-Security-Policy allows scripts and workers from itself alone.
// `public` holds the kernel for `npm run dev` alone: a build gets the one of its own (build_page.cmake).
export default defineConfig(({ command }) => ({
  publicDir: command === 'serve' ? 'public' : false,
  base: './',
  build: { target: 'es2022', assetsInlineLimit: 0, modulePreload: { polyfill: false } },
  server: { proxy: { '/api': 'http://127.0.0.1:8080', '/ws': { target: 'ws://127.0.0.1:8080', ws: true } } },
}));
